# SPDX-License-Identifier: Apache-2.0
# Cases of cuda and hip on a simulated GPU (tests/openacc/simulated_cuda.c). For cuda it runs the PTX that nvcc wrote
# into the program. For hip it runs the source of the kernels, compiled for the host, and not the code objects of the
# program. Pictures have the bits of the scalar kernel. If the GPU is missing or fails, the program prints one line and
# exits with the right code. The backend is the last part of the name of the folder GPU.
backend=${3##*/}
wrote=nvcc
most_calls=15
library=libcuda.so.1
vendor=NVIDIA
refusal="NVIDIA's driver, CUDA 11.4, does not load the kernels, which need CUDA [0-9.]* or newer"
. "$(dirname "$script")/../openacc/simulated.sh"
export SIMULATED_CAPABILITY=90
if [ $backend = hip ]; then
    library=libamdhip64.so.7
    vendor=AMD
    refusal="AMD's driver, HIP 6.2, does not load the kernels, which need a GPU gfx90a, gfx942"
    names=$(sed -nE 's/.*"(cu\w+)", "(hip\w+)".*/\1=\2/p' "$source/core/gpu/driver.cpp")
    own() { sed -n "s/^$1=//p" <<<"$names"; }
    renamed=(-DSIMULATED_AMD $(sed 's/^/-D/' <<<"$names"))
    # kernels FOLDER [OPTION...]: compiles the kernels for the host, with more options of the compiler.
    kernels() {
        local folder=$1 file
        for file in "$bin"/../backends/hip/loops_*.cu; do
            "$compiler" -x c++ -std=c++17 -O1 -ffp-contract=off -fno-math-errno -fno-trapping-math -w -Wno-psabi -fPIC \
                "-I$source" -include "$source/tests/cuda/host_words.h" "${@:2}" \
                -c "$file" -o "$folder/$(basename "$file").o" || return 1
        done
        nm "$folder"/*.o | awk '$2 == "T" { print $3 }' >names
        {
            printf '#include <stdint.h>\n#include <string.h>\nstatic unsigned threads_of_block;\n'
            sed 's/.*/void &(uint64_t);/' names
            echo 'static const struct { const char* name; void* run; } kernels[] = {'
            sed 's/.*/{"&", &},/' names
            echo '};'
        } >"$folder/kernels.h"
    }
    mutants() { kernels "$1" -ffast-math; }
fi
never_again=$(own cuMemAlloc_v2)

# Blocks of every size give the same picture. bench leaves out the block sizes that the kernel's registers do not allow,
# and measures the others.
test_block_sizes() {
    blocks() {
        SIMULATED_BLOCKS=1 "$bin/bench" --backend $backend --study block-sizes --size 60x40 --precision float --mode fast \
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
    says "no $vendor GPU is here"
    [ $backend = hip ] && return
    SIMULATED_CAPABILITY=20 expect 77 bulb --output b.png
    says 'of compute capability .* and up, device 0 has 20'
}

test_failures() {
    local fault
    for fault in 'launch:launching a kernel: simulated error \(701\)' \
        'lost:running a kernel: unspecified launch failure \(719\)' 'timeout:running a kernel: the launch timed out'; do
        SIMULATED_FAULT=${fault%%:*} expect 1 bulb --output b.png
        says "$backend: ${fault#*:}"
        [ -e b.png ] && fail "a picture from a GPU that failed"
    done
    SIMULATED_FAULT=version expect 77 bulb --output b.png
    says "$refusal"
    # Makes a driver that lacks most functions.
    mkdir none
    echo 'int cuInit(unsigned f) { return 100; }' >none.c
    driver none none.c || fail "building the old driver"
    LD_LIBRARY_PATH=$PWD/none expect 77 bulb --output b.png
    says "$vendor.s driver is too old: it has no"
    : | tee none/libcuda.so.1 none/libamdhip64.so.{5,6,7}
    LD_LIBRARY_PATH=$PWD/none expect 77 bulb --output b.png
    says "there is no $vendor driver: .*$library: file too short"
}
