#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# simulated_test.sh BIN SOURCE COMPILER PYTHON: runs the programs on a simulated GPU (simulated_cuda.c), which runs the
# PTX in the program. Its pictures must have the bits of the scalar kernel, several GPUs can be selected, and a failing
# GPU must give one line and the right exit code.
set -uo pipefail
backend=openacc bin=$1 source=$2 compiler=$3
. "$source/tests/openacc/simulated.sh"

"$4" "$source/tests/openacc/ptx_to_c.py" gcc "$bin/mandelbulb" >kernels.h || exit 1
driver . || exit 1
export LD_LIBRARY_PATH=$folder
check_bits "bulb paramsBulb.dat" "box paramsBox.dat"

# Devices 0 to 2 are the simulated GPUs, device 3 is the host.
export SIMULATED_GPUS=3
expect 0 0 '' --device 2 --output a.png --stats a.json
grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
expect 0 1 'runs on the host, one thread: instead of a GPU' --device 3 --output a.png
expect 77 1 'there is no device 4, only 0 to 3' --device 4 --output b.png
unset SIMULATED_GPUS
backend=auto expect 0 1 '^backend openacc: openacc has the GPU Simulated K40 number 0' --output a.png

# In the stats, `kernel` is the time by the GPU's clock, 3 s as each of three kernels takes a simulated second, and
# `host` is the wall time around it. Negative control: if the GPU has no clock, both are wall times.
expect 0 0 '' --mode exact --output a.png --stats a.json
[ "$(seconds kernel)" = 3.0 ] || fail "kernel is $(seconds kernel) s, not the GPU's 3"
[ "$(seconds host)" != 3.0 ] || fail "host is the GPU's time"
SIMULATED_CLOCK=0 expect 0 0 '' --mode exact --output a.png --stats a.json
[ "$(seconds kernel)" != 3.0 ] || fail "kernel is 3 s without a clock"

# The picture has slightly more than 2^19 pixels, so it is rendered in two bands; if a watchdog ends long launches, in
# three. Each of the bands takes three launches of a second.
large() { "$bin/mandelbulb" paramsBulb.dat --size 750x700 --backend openacc --mode fast --precision float --without trial --output a.png --stats a.json; }
large || fail "a picture of 2^19 pixels"
[ "$(seconds kernel)" = 6.0 ] || fail "kernel is $(seconds kernel) s, not that of two launches"
SIMULATED_WATCHED=1 large || fail "a picture under a watchdog"
[ "$(seconds kernel)" = 9.0 ] || fail "kernel is $(seconds kernel) s, not that of three launches under a watchdog"

# On these failures, gcc's run-time library prints its own message and ends the device process.
SIMULATED_FAULT=launch expect 1 1 'last words: libgomp: cuLaunchKernel error' --output b.png
SIMULATED_FAULT=lost expect 1 1 'last words: libgomp: .*unspecified launch failure' --output b.png
SIMULATED_FAULT=timeout expect 1 1 'last words: libgomp: .*launch timed out' --output b.png
SIMULATED_MEMORY=40000 expect 1 1 'Simulated K40 number 0 has .* bytes of memory free' --output b.png
SIMULATED_MEMORY=80000 expect 0 0 '' --output c.png  # in many bands
[ -e b.png ] && fail "a picture from a GPU that failed"
finish
