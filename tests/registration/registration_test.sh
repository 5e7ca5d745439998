#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# registration_test.sh BIN SOURCE PYTHON: a line in the list of backends is all that programs need to support a backend.
# Programs with the skeleton's line support it; the same sources, built without that line, reject its name.
set -euo pipefail
bin=$1
source=$2
python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; exit 1; }
# refused PROGRAM ARGUMENT...: expects a usage error that names the skeleton.
refused() {
    local code=0
    "$@" >/dev/null 2>err || code=$?
    [ "$code" = 2 ] && grep -q skeleton err || fail "$* exited with $code: $(cat err)"
}
scene=(--fractal box "$source/paramsBox.dat" --size 48x40)

"$bin/render_with_skeleton" --help | grep -q '{auto,reference,openmp,.*,skeleton}' || fail "--help lists no skeleton"
"$bin/render" --help | grep -q skeleton && fail "--help of render lists the skeleton"
"$bin/render_with_skeleton" --list-devices | grep -q '^skeleton *0: skeleton' || fail "its device is not listed"
"$bin/render_with_skeleton" --list-devices | grep -q '^openmp *0: ' || fail "openmp is not listed"

# The skeleton's pictures have the expected bits. In fast mode there is a trial first, as for every backend but the
# reference.
"$bin/render_with_skeleton" "${scene[@]}" --backend skeleton --output skeleton.exr --stats skeleton.json
"$bin/render" "${scene[@]}" --backend openmp --simd-width 1 --output openmp.exr
"$bin/imgdiff" skeleton.exr openmp.exr >/dev/null || fail "the skeleton draws other bits"
grep -q '"backend": "skeleton"' skeleton.json || fail "another backend drew"
"$bin/render_with_skeleton" "${scene[@]}" --backend skeleton --mode fast --output fast.exr --stats fast.json
grep -q "\"step_factor\": 0" fast.json || fail "no trial went before the fast picture: $(cat fast.json)"
grep -q "\"step_factor\": null" skeleton.json || fail "an exact picture has a trial"
refused "$bin/render" "${scene[@]}" --backend skeleton --output no.exr

# bench verifies and times it, and reports how it was built.
race=(--backend skeleton --fractal box --precision float --mode exact --size 32x32 --repetitions 6)
"$bin/bench_with_skeleton" --list "${race[@]}" | grep -q '^mandelbox/float/exact/skeleton/0' || fail "--list has no row"
"$bin/bench_with_skeleton" "${race[@]}" --json result.json >table || fail "bench: $(cat table)"
"$python" - "$bin" <<'PY' || fail "the result"
import json
import subprocess
import sys

result = json.load(open("result.json"))
row = next(row for row in result["rows"] if row["backend"] == "skeleton")
assert row["verification"]["level"] == "same bits" and row["figures"]["kernel_seconds"]["median"] > 0, row
backends = result["environment"]["backends"]
devices = subprocess.run([sys.argv[1] + "/render", "--list-devices"], capture_output=True, text=True).stdout
listed = dict.fromkeys(line.split()[0] for line in devices.splitlines())
assert [backend["name"] for backend in backends] == [*listed, "skeleton"], backends
for backend in backends:
    built = backend["unavailable"] != "not built"
    for fact in "compiler", "flags_exact", "flags_fast":
        assert bool(backend[fact]) == built, (backend["name"], fact)
assert "-ffp-contract=off" in backends[-1]["flags_exact"], backends[-1]
assert [b["name"] for b in backends if b["role"] == "reference"] == ["reference"], backends
PY
refused "$bin/bench" "${race[@]}"
