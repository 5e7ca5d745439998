# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE PYTHON: one line in the list of backends makes all programs support a
# backend. Programs that are built with the skeleton's line support the backend skeleton. Programs that are built from
# the same sources without that line reject the backend's name.
bin=$1
source=$2
python=$3
scene=(--fractal box "$source/paramsBox.dat" --size 48x40)
few=(--backend skeleton --fractal box --precision float --mode exact --size 32x32)

test_lists() {
    expect 0 "$bin/render_with_skeleton" --help
    prints '\{auto,reference,openmp,.*,skeleton\}'
    "$bin/render" --help | grep -q skeleton && fail "--help of render lists the skeleton"
    expect 0 "$bin/render_with_skeleton" --list-devices
    prints '^skeleton *0: .*a plain loop'
    prints '^openmp *0: '
    expect 2 "$bin/render" "${scene[@]}" --backend skeleton --output no.exr
    says skeleton
    expect 2 "$bin/bench" "${few[@]}"
    says skeleton
}

# In fast mode a trial is rendered first, as with every backend but the reference. tests/equivalence tests the bits.
test_pictures() {
    expect 0 "$bin/render_with_skeleton" "${scene[@]}" --backend skeleton --output exact.exr --stats exact.json
    grep -q '"backend": "skeleton"' exact.json || fail "another backend drew"
    expect 0 "$bin/render_with_skeleton" "${scene[@]}" --backend skeleton --mode fast --output fast.exr --stats fast.json
    grep -q "\"step_factor\": 0" fast.json || fail "no trial went before the fast picture: $(cat fast.json)"
    grep -q "\"step_factor\": null" exact.json || fail "an exact picture has a trial"
}

# bench verifies and times the skeleton, and reports how it was built.
test_bench() {
    expect 0 "$bin/bench_with_skeleton" --list "${few[@]}"
    prints '^mandelbox/float/exact/skeleton/0'
    expect 0 "$bin/bench_with_skeleton" "${few[@]}" --repetitions 6 --json result.json
    "$python" - "$bin" <<'PY' || fail "the result"
import json
import subprocess
import sys

result = json.load(open("result.json"))
row = next(row for row in result["rows"] if row["backend"] == "skeleton")
assert row["verification"]["level"] == "same bits" and row["samples"][0]["kernel"] > 0, row
backends = result["environment"]["backends"]
devices = subprocess.run([sys.argv[1] + "/render", "--list-devices"], capture_output=True, text=True).stdout
listed = dict.fromkeys(line.split()[0] for line in devices.splitlines())
assert [backend["name"] for backend in backends] == [*listed, "skeleton"], backends
assert "-ffp-contract=off" in backends[-1]["flags_exact"], backends[-1]
PY
}
