#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program_test.sh BIN SOURCE: the programs without a GPU report that the host renders, and reject a missing GPU.
set -uo pipefail
bin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$2"/params*.dat "$folder"
cd "$folder"
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
export CUDA_VISIBLE_DEVICES=  # hides any GPU

"$bin/mandelbulb" paramsBulb.dat --size 40x30 --backend openacc --output a.png --stats a.json 2>stderr || fail "exit code $?"
[ "$(wc -l <stderr)" = 1 ] || fail "$(wc -l <stderr) lines on stderr"
grep -q '^backend openacc: runs on the host, one thread: no NVIDIA GPU' stderr || fail "stderr: $(cat stderr)"
grep -q '"name": "host, one thread: no NVIDIA GPU' a.json || fail "the result file does not name the host"
"$bin/mandelbulb" paramsBulb.dat --size 40x30 --backend openacc --device 1 --output b.png 2>stderr
code=$?
[ $code = 77 ] || fail "exit code $code for a device that is not there, expected 77"
[ "$(wc -l <stderr)" = 1 ] || fail "$(wc -l <stderr) lines on stderr"
grep -q 'there is no device 1' stderr || fail "stderr: $(cat stderr)"
[ -e b.png ] && fail "a picture from a device that is not there"
"$bin/mandelbulb" paramsBulb.dat --size 40x30 --output c.png --stats c.json 2>stderr || fail "exit code $?"
grep -q '^backend openmp: openacc has no GPU' stderr || fail "auto says: $(cat stderr)"
grep -q '"backend": "openmp"' c.json || fail "auto took another backend than openmp"
[ $failures = 0 ] && echo "all well"
exit $((failures > 0))
