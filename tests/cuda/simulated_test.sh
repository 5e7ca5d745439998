#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# simulated_test.sh BIN SOURCE COMPILER PYTHON: the cuda backend on a simulated GPU (tests/openacc/simulated_cuda.c),
# which runs the PTX that nvcc wrote into the program. Its pictures must have the bits of the scalar kernel, and a
# missing or failing GPU must give one line and the right exit code.
set -uo pipefail
backend=cuda bin=$1 source=$2 compiler=$3
. "$source/tests/openacc/simulated.sh"

"$4" "$source/tests/openacc/ptx_to_c.py" nvcc "$bin/mandelbulb" >kernels.h || exit 1
driver . || exit 1
mkdir none && echo 'int cuInit(unsigned f) { return 100; }' >none.c
driver none none.c || exit 1
LD_LIBRARY_PATH=$folder/none expect 77 1 'cuda: NVIDIA.s driver is too old' --output b.png
export LD_LIBRARY_PATH=$folder SIMULATED_CAPABILITY=90
check_bits "bulb paramsBulb.dat" "box paramsBox.dat" "julia paramsJulia.dat"
[ "$(grep -c '"registers": 100,' gpu.json)" = 3 ] || fail "the driver's registers of three kernels: $(cat gpu.json)"

# In the stats, `kernel` is the time by the GPU's clock: 3 s, as each of three kernels takes a simulated second.
expect 0 0 '' --mode exact --output a.png --stats a.json
[ "$(seconds kernel)" = 3.0 ] || fail "kernel is $(seconds kernel) s, not the GPU's 3"

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
