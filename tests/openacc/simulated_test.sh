# SPDX-License-Identifier: Apache-2.0
# Cases of openacc on a simulated GPU. Pictures have the bits of the scalar kernel. Each of several GPUs can be
# selected. If the GPU fails, the program prints one line and exits with the right code.
backend=openacc
wrote=gcc
most_calls=52
never_again=
library=libcuda.so.1
. "$(dirname "$script")/simulated.sh"

# Devices 0 to 2 are the simulated GPUs, device 3 is the host.
test_devices() {
    export SIMULATED_GPUS=3
    expect 0 bulb --device 2 --output a.png --stats a.json
    silent
    grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
    expect 0 bulb --device 3 --output a.png
    says 'runs on the host, one thread: instead of a GPU'
    expect 77 bulb --device 4 --output b.png
    says 'there is no device 4, only 0 to 3'
    unset SIMULATED_GPUS
    backend=auto expect 0 bulb --output a.png
    says '^drawing with openacc \(GPU Simulated K40 number 0\)$'
}

# On these failures, gcc's run-time library prints its own message and ends the device process.
test_failures() {
    local fault
    for fault in "launch:cuLaunchKernel error" "lost:.*unspecified launch failure" "timeout:.*launch timed out"; do
        SIMULATED_FAULT=${fault%%:*} expect 1 bulb --output b.png
        says "last words: libgomp: ${fault#*:}"
        [ -e b.png ] && fail "a picture from a GPU that failed"
    done
}
