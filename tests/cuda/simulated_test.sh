#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# simulated_test.sh BIN SOURCE COMPILER PYTHON: the cuda backend on a simulated GPU (tests/openacc/simulated_cuda.c),
# which runs the PTX that nvcc wrote into the program. Its pictures must have the bits of the scalar kernel, and a
# missing or failing GPU must give one line and the right exit code.
set -uo pipefail
bin=$1
. "$2/tests/failures.sh"
cp "$2"/params*.dat "$folder"
cd "$folder"
# expect CODE LINES PATTERN ARGUMENT...: checks mandelbulb's exit code and stderr.
expect() {
    local code=$1 lines=$2 pattern=$3 got
    shift 3
    "$bin/mandelbulb" paramsBulb.dat --size 60x40 --backend cuda "$@" 2>stderr
    got=$?
    [ $got = "$code" ] || fail "exit code $got, expected $code: $*"
    [ "$(grep -c . stderr)" = "$lines" ] || fail "$lines lines expected on stderr: $* : $(cat stderr)"
    grep -q "$pattern" stderr || [ -z "$pattern" ] || fail "stderr does not say '$pattern': $(cat stderr)"
}

"$4" "$2/tests/cuda/nvcc_to_c.py" "$bin/mandelbulb" >kernels.h || exit 1
build="$3 -x c -std=gnu11 -O1 -ffp-contract=off -fno-math-errno -w -shared -fPIC -I. $2/tests/openacc/simulated_cuda.c -lm -o"
$build libcuda.so.1 || exit 1
mkdir none && echo 'int cuInit(unsigned f) { return 100; }' >none.c
${build/"$2/tests/openacc/simulated_cuda.c"/none.c} none/libcuda.so.1 || exit 1
unset CUDA_VISIBLE_DEVICES
LD_LIBRARY_PATH=$folder/none expect 77 1 'cuda: NVIDIA.s driver is too old' --output b.png
export LD_LIBRARY_PATH=$folder SIMULATED_CAPABILITY=90

# In exact mode the PTX gives the scalar kernel's bits and counts the same work.
sed 's/^0 4.0 8.0/0 4.0 7.5/' paramsBulb.dat >power.dat
sed 's/^2 0.5 1/-1.5 0.5 1/' paramsBox.dat >scale.dat
for scene in "bulb paramsBulb.dat" "bulb power.dat" "box paramsBox.dat" "box scale.dat" "julia paramsJulia.dat"; do
    for precision in float double; do
        draw="$bin/render --fractal $scene --size 170x131 --precision $precision"
        $draw --backend cuda --output gpu.exr --stats gpu.json || fail "$draw"
        $draw --backend openmp --simd-width 1 --output cpu.exr --stats cpu.json || fail "$draw"
        "$bin/imgdiff" gpu.exr cpu.exr >difference || fail "the PTX draws other bits: $scene $precision: $(cat difference)"
        [ "$(grep -A3 '"work"' gpu.json)" = "$(grep -A3 '"work"' cpu.json)" ] || fail "the PTX does other work: $scene"
    done
done
[ "$(grep -c '"registers": 100,' gpu.json)" = 3 ] || fail "the driver's registers of three kernels: $(cat gpu.json)"
grep -q '"name": "Simulated K40 number 0"' gpu.json || fail "the result file does not name the GPU"
$draw --backend cuda --mode fast --output fast.exr || fail "fast mode"
"$bin/imgdiff" fast.exr cpu.exr >/dev/null && fail "fast mode has exact mode's bits"

# Negative control: a simulated GPU that rounds an addition differently.
sed -E 's/^(fd?[0-9]+) = \(\(double\)(fd[0-9]+)\) \+ \(\(double\)(fd[0-9]+)\);/\1 = fma(\2, 1.0000000000000002, \3);/' kernels.h >twin.h
cmp -s kernels.h twin.h && fail "the twin is no twin"
mkdir twin && mv twin.h twin/kernels.h
${build/-I. /-Itwin } twin/libcuda.so.1 || fail "building the twin"
LD_LIBRARY_PATH=$folder/twin $draw --backend cuda --output twin.exr || fail "the twin does not draw"
"$bin/imgdiff" twin.exr cpu.exr >/dev/null && fail "the twin that rounds otherwise was not seen"

# In the stats, `kernel` is the time by the GPU's clock: 3 s, as each of three kernels takes a simulated second.
expect 0 0 '' --mode exact --output a.png --stats a.json
grep -q '"kernel": 3.0,' a.json || fail "kernel is not the GPU's time: $(grep '"kernel"' a.json)"

# Blocks of every size give the same picture.
SIMULATED_BLOCKS=1 "$bin/bench" --backend cuda --study block-sizes --size 60x40 --precision float --mode fast --repetitions 1 --no-peaks >blocks 2>&1 ||
    fail "blocks: $(cat blocks)"
[ "$(grep -c '^b.*block-size=.* % off' blocks)" = 10 ] || fail "blocks of five sizes of two fractals: $(cat blocks)"

# A block size that the kernel's registers do not allow is left out; the other sizes are rendered.
SIMULATED_BLOCKS=1 SIMULATED_REGISTERS=144 "$bin/bench" --backend cuda --study block-sizes --size 60x40 --precision float --mode fast --repetitions 1 --no-peaks >blocks 2>&1
[ "$(grep -c '^b.*block-size=.* % off' blocks)" = 8 ] || fail "blocks of four sizes of two fractals, and two that do not fit: $(cat blocks)"
grep -q '512 threads a block given' blocks || fail "blocks that do not fit: $(cat blocks)"

export SIMULATED_GPUS=3
expect 0 0 '' --device 2 --output a.png --stats a.json
grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
expect 77 1 'there is no device 3, only 0 to 2' --device 3 --output b.png
SIMULATED_GPUS=0 expect 77 1 'no NVIDIA GPU is here' --output b.png
SIMULATED_CAPABILITY=20 expect 77 1 'of compute capability .* and up, device 0 has 20' --output b.png
unset SIMULATED_GPUS

SIMULATED_FAULT=version expect 77 1 "NVIDIA's driver is for CUDA 11.4, the kernels need one for CUDA [0-9.]* or newer" --output b.png
SIMULATED_FAULT=launch expect 1 1 'cuda: launching a kernel: simulated error (701)' --output b.png
SIMULATED_FAULT=lost expect 1 1 'cuda: running a kernel: unspecified launch failure (719)' --output b.png
SIMULATED_FAULT=timeout expect 1 1 'cuda: running a kernel: the launch timed out' --output b.png
SIMULATED_MEMORY=40000 expect 1 1 'Simulated K40 number 0 has .* bytes of memory free' --output b.png
SIMULATED_MEMORY=80000 expect 0 0 '' --output c.png  # in many bands
[ -e b.png ] && fail "a picture from a GPU that failed"
finish
