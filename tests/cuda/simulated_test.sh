# SPDX-License-Identifier: Apache-2.0
# Cases of cuda on a simulated GPU (tests/openacc/simulated_cuda.c), which runs the PTX that nvcc wrote into the
# program. Pictures have the bits of the scalar kernel. If the GPU is missing or fails, the program prints one line and
# exits with the right code.
backend=cuda
wrote=nvcc
most_calls=15
never_again=cuMemAlloc_v2
. "$(dirname "$script")/../openacc/simulated.sh"
export SIMULATED_CAPABILITY=90

# Blocks of every size give the same picture. bench leaves out the block sizes that the kernel's registers do not allow,
# and measures the others.
test_block_sizes() {
    blocks() {
        SIMULATED_BLOCKS=1 "$bin/bench" --backend cuda --study block-sizes --size 60x40 --precision float --mode fast \
            --repetitions 1 --no-peaks >blocks 2>&1
    }
    blocks || fail "blocks: $(cat blocks)"
    [ "$(grep -c '^b.*block-size=.* % off' blocks)" = 10 ] || fail "blocks of five sizes of two fractals: $(cat blocks)"
    SIMULATED_REGISTERS=144 blocks
    [ "$(grep -c '^b.*block-size=.* % off' blocks)" = 8 ] || fail "blocks of four sizes of two fractals, and two that do not fit: $(cat blocks)"
    grep -q '512 threads a block given' blocks || fail "blocks that do not fit: $(cat blocks)"
}

test_devices() {
    export SIMULATED_GPUS=3
    expect 0 bulb --device 2 --output a.png --stats a.json
    silent
    grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
    expect 77 bulb --device 3 --output b.png
    says 'there is no device 3, only 0 to 2'
    SIMULATED_GPUS=0 expect 77 bulb --output b.png
    says 'no NVIDIA GPU is here'
    SIMULATED_CAPABILITY=20 expect 77 bulb --output b.png
    says 'of compute capability .* and up, device 0 has 20'
}

test_failures() {
    local fault
    for fault in 'launch:launching a kernel: simulated error \(701\)' \
        'lost:running a kernel: unspecified launch failure \(719\)' 'timeout:running a kernel: the launch timed out'; do
        SIMULATED_FAULT=${fault%%:*} expect 1 bulb --output b.png
        says "cuda: ${fault#*:}"
        [ -e b.png ] && fail "a picture from a GPU that failed"
    done
    SIMULATED_FAULT=version expect 77 bulb --output b.png
    says "NVIDIA's driver is for CUDA 11.4, the kernels need one for CUDA [0-9.]* or newer"
    # Makes a driver that lacks most functions.
    mkdir none
    echo 'int cuInit(unsigned f) { return 100; }' >none.c
    driver none none.c || fail "building the old driver"
    LD_LIBRARY_PATH=$PWD/none expect 77 bulb --output b.png
    says "cuda: NVIDIA.s driver is too old"
}
