#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# programs_test.sh BIN FRACTALS: every program supports the fractal of FRACTALS, which is defined in its two files only.
set -euo pipefail
bin=$1
name=$(basename "$2"/*.h .h)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python() { python3 -c "import json, sys; data = json.load(open(sys.argv[1])); $2" "$1"; }

# Copies the official parameter file from the fractal's descriptor.
sed -n '/R"dat(/,/^)dat"/p' "$2/$name.cpp" | sed -e 's/.*R"dat(//' -e '/^)dat"/d' >"$name.dat"

echo "render draws it"
"$bin/render" --fractal "$name" "$name.dat" --size 120x90 --backend openmp --output a.exr
"$bin/render" --fractal "$name" "$name.dat" --size 120x90 --backend openmp --simd-width 1 --output b.exr
"$bin/imgdiff" a.exr b.exr
"$bin/render" --fractal "$name" "$name.dat" --size 120x90 --backend openmp --precision float --output b.exr
if "$bin/imgdiff" a.exr b.exr; then
    echo "the comparison cannot fail"
    exit 1
fi

echo "reference says that it does not"
code=0
"$bin/render" --fractal "$name" "$name.dat" --backend reference --output c.exr || code=$?
[ $code = 77 ]

echo "every backend draws its extreme scenes with the same bits"
"$bin/bench" equivalence --fractal "$name" --scenes 60 --json equivalence.json
python equivalence.json "assert data['discrepancies'] == [], data['discrepancies']; assert len(data['subjects']) >= 2
assert all(one['pictures'] > 50 for one in data['subjects']), data['subjects']"

echo "bench races it"
"$bin/bench" --fractal "$name" --size 96x72 --repetitions 2 --no-peaks --json result.json >table
python result.json "
rows = [row for row in data['rows'] if row['fractal'] == '$name']
assert {row['backend'] for row in rows if row.get('samples')} >= {'openmp'}, rows
assert {(row['precision'], row['mode']) for row in rows} == {(p, m) for p in ('float', 'double') for m in ('exact', 'fast')}
assert not [row for row in data['rows'] if row.get('failure')]"

echo "bench random draws it"
"$bin/bench" random --fractal "$name" --scenes 4 --sets 1,2 --json random.json >table
python random.json "assert {scene['fractal'] for scene in data['scenes']} == {data['sums'][0]['fractal']}
assert len(data['scenes']) == 2 * 4 * 2"

echo "the viewer computes what the programs draw"
python3 "$2/../report/viewer_test.py" "$bin/render"

echo "flythrough plans a flight through it, and makes pictures of one"
"$bin/flythrough" plan --fractal "$name" --frames 90 --output path.json >table
python path.json "assert data['fractal'] == '$name' and len(data['frames']) == 90"
"$bin/flythrough" render path.json --stills stills --every 45 --size 64x36 --samples 1
[ "$(find stills -name '*.png' | wc -l)" = 2 ]
if command -v ffmpeg >/dev/null; then
    "$bin/flythrough" render path.json --size 64x36 --samples 1 --output film.mp4
    [ -s film.mp4 ]
fi
