# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN FRACTALS: every program supports the fractal in the folder FRACTALS. Only the two
# files of this folder define the fractal.
bin=$1
fractals=$2
name=$(basename "$fractals"/*.h .h)
# holds FILE CODE: runs Python code, in which `data` is the content of a JSON file, and fails if an assertion fails.
holds() { python3 -c "import json, sys; data = json.load(open(sys.argv[1])); $2" "$1" || fail "$1 is not as expected"; }

test_render() {
    draw=("$bin/render" --fractal "$name" --size 120x90 --backend)
    expect 0 "${draw[@]}" openmp --output a.exr
    expect 0 "${draw[@]}" openmp --simd-width 1 --output b.exr
    same_picture a.exr b.exr
    expect 0 "${draw[@]}" openmp --precision float --output b.exr
    other_picture a.exr b.exr
    expect 77 "${draw[@]}" reference --output c.exr
}

test_equivalence() {
    expect 0 "$bin/bench" equivalence --fractal "$name" --scenes 60 --json equivalence.json
    holds equivalence.json "assert data['discrepancies'] == [], data['discrepancies']; assert len(data['subjects']) >= 2
assert all(one['pictures'] > 50 for one in data['subjects']), data['subjects']"
}

test_bench() {
    expect 0 "$bin/bench" --fractal "$name" --size 96x72 --repetitions 2 --no-peaks --json result.json
    holds result.json "
rows = [row for row in data['rows'] if row['fractal'] == '$name']
assert {row['backend'] for row in rows if row.get('samples')} >= {'openmp'}, rows
assert {(row['precision'], row['mode']) for row in rows} == {(p, m) for p in ('float', 'double') for m in ('exact', 'fast')}
assert not [row for row in data['rows'] if row.get('failure')]"
}

test_bench_random() {
    expect 0 "$bin/bench" random --fractal "$name" --scenes 4 --sets 1,2 --json random.json
    holds random.json "assert len({scene['fractal'] for scene in data['scenes']}) == 1
assert len(data['scenes']) == 2 * 4 * 2"
}

test_viewer() { python3 "$fractals/../report/viewer_test.py" "$bin/render" || fail "the viewer computes something else"; }

test_flythrough() {
    expect 0 "$bin/flythrough" plan --fractal "$name" --frames 90 --output path.json
    holds path.json "assert data['fractal'] == '$name' and len(data['frames']) == 90"
    expect 0 "$bin/flythrough" render path.json --stills stills --every 45 --size 64x36 --samples 1
    [ "$(find stills -name '*.png' | wc -l)" = 2 ] || fail "stills: $(ls stills)"
    expect 0 "$bin/flythrough" render path.json --size 64x36 --samples 1 --output film.mp4
    [ -s film.mp4 ] || fail "no film"
}
