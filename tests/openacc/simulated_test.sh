#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# simulated_test.sh BIN SOURCE COMPILER PYTHON: runs the programs on a simulated GPU (simulated_cuda.c), which runs the
# PTX in the program. Its pictures must have the bits of the scalar kernel, several GPUs can be selected, and a failing
# GPU must give one line and the right exit code.
set -uo pipefail
bin=$1
here=$2/tests/openacc
. "$2/tests/failures.sh"
cp "$2"/params*.dat "$folder"
cd "$folder"
# expect CODE LINES PATTERN ARGUMENT...: checks mandelbulb's exit code and stderr.
expect() {
    local code=$1 lines=$2 pattern=$3 got
    shift 3
    "$bin/mandelbulb" paramsBulb.dat --size 60x40 "$@" 2>stderr
    got=$?
    [ $got = "$code" ] || fail "exit code $got, expected $code: $*"
    [ "$(grep -c . stderr)" = "$lines" ] || fail "$lines lines expected on stderr: $* : $(cat stderr)"
    grep -q "$pattern" stderr || [ -z "$pattern" ] || fail "stderr does not say '$pattern': $(cat stderr)"
}

PYTHONDONTWRITEBYTECODE=1 "$4" - "$2" "$bin/mandelbulb" >kernels.h <<'END' || exit 1
import sys
sys.path[:0] = [sys.argv[1] + "/tools", sys.argv[1] + "/tests/openacc"]
import k40
import ptx_to_c
print(ptx_to_c.translate(k40.kernels(k40.extract(sys.argv[2])[0])))
END
build="$3 -x c -std=gnu11 -O1 -ffp-contract=off -fno-math-errno -w -shared -fPIC -I. $here/simulated_cuda.c -lm -o"
$build libcuda.so.1 || exit 1
export LD_LIBRARY_PATH=$folder
unset CUDA_VISIBLE_DEVICES

# In exact mode the PTX gives the scalar kernel's bits and counts the same work.
sed 's/^0 4.0 8.0/0 4.0 7.5/' paramsBulb.dat >power.dat
sed 's/^2 0.5 1/-1.5 0.5 1/' paramsBox.dat >scale.dat
for scene in "bulb paramsBulb.dat" "bulb power.dat" "box paramsBox.dat" "box scale.dat"; do
    for precision in float double; do
        draw="$bin/render --fractal $scene --size 170x131 --precision $precision"
        $draw --backend openacc --output gpu.exr --stats gpu.json || fail "$draw"
        $draw --backend openmp --simd-width 1 --output cpu.exr --stats cpu.json || fail "$draw"
        "$bin/imgdiff" gpu.exr cpu.exr >difference || fail "the PTX draws other bits: $scene $precision: $(cat difference)"
        [ "$(grep -A3 '"work"' gpu.json)" = "$(grep -A3 '"work"' cpu.json)" ] || fail "the PTX does other work: $scene"
    done
done
grep -q '"name": "Simulated K40 number 0"' gpu.json || fail "the result file does not name the GPU"
$draw --backend openacc --mode fast --output fast.exr || fail "fast mode"
"$bin/imgdiff" fast.exr cpu.exr >/dev/null && fail "fast mode has exact mode's bits"

# Negative control: a GPU that fuses a multiplication and an addition that must not be fused.
sed -E 's/^(r[0-9]+) = \(\(double\)(r[0-9]+)\) \+ \(\(double\)(r[0-9]+)\);/\1 = fma(\2, 1.0000000000000002, \3);/' kernels.h >twin.h
mkdir twin && mv twin.h twin/kernels.h
${build/-I. /-Itwin } twin/libcuda.so.1 || fail "building the twin"
LD_LIBRARY_PATH=$folder/twin $draw --backend openacc --output twin.exr || fail "the twin does not draw"
"$bin/imgdiff" twin.exr cpu.exr >/dev/null && fail "the twin that rounds otherwise was not seen"

# Devices 0 to 2 are the simulated GPUs, device 3 is the host.
export SIMULATED_GPUS=3
expect 0 0 '' --backend openacc --device 2 --output a.png --stats a.json
grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
expect 0 1 'runs on the host, one thread: instead of a GPU' --backend openacc --device 3 --output a.png
expect 77 1 'there is no device 4, only 0 to 3' --backend openacc --device 4 --output b.png
unset SIMULATED_GPUS
expect 0 1 '^backend openacc: openacc has the GPU Simulated K40 number 0' --output a.png

# In the stats, `kernel` is the time by the GPU's clock, 3 s as each of three kernels takes a simulated second, and
# `host` is the wall time around it. Negative control: if the GPU has no clock, both are wall times.
seconds() { sed -n "s/.*\"$1\": \([0-9.e-]*\),\{0,1\}$/\1/p" a.json; }
expect 0 0 '' --backend openacc --mode exact --output a.png --stats a.json
[ "$(seconds kernel)" = 3.0 ] || fail "kernel is $(seconds kernel) s, not the GPU's 3"
[ "$(seconds host)" != 3.0 ] || fail "host is the GPU's time"
SIMULATED_CLOCK=0 expect 0 0 '' --backend openacc --mode exact --output a.png --stats a.json
[ "$(seconds kernel)" != 3.0 ] || fail "kernel is 3 s without a clock"

# The picture has slightly more than 2^19 pixels, so it is rendered in two bands; if a watchdog ends long launches, in
# three. Each of the bands takes three launches of a second.
large() { "$bin/mandelbulb" paramsBulb.dat --size 750x700 --backend openacc --mode fast --precision float --without trial --output a.png --stats a.json; }
large || fail "a picture of 2^19 pixels"
[ "$(seconds kernel)" = 6.0 ] || fail "kernel is $(seconds kernel) s, not that of two launches"
SIMULATED_WATCHED=1 large || fail "a picture under a watchdog"
[ "$(seconds kernel)" = 9.0 ] || fail "kernel is $(seconds kernel) s, not that of three launches under a watchdog"

# On these failures, gcc's run-time library prints its own message and ends the device process.
SIMULATED_FAULT=launch expect 1 1 'last words: libgomp: cuLaunchKernel error' --backend openacc --output b.png
SIMULATED_FAULT=lost expect 1 1 'last words: libgomp: .*unspecified launch failure' --backend openacc --output b.png
SIMULATED_FAULT=timeout expect 1 1 'last words: libgomp: .*launch timed out' --backend openacc --output b.png
SIMULATED_MEMORY=40000 expect 1 1 'Simulated K40 number 0 has .* bytes of memory free' --backend openacc --output b.png
SIMULATED_MEMORY=80000 expect 0 0 '' --backend openacc --output c.png  # in many bands
[ -e b.png ] && fail "a picture from a GPU that failed"
finish
