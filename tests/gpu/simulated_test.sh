# SPDX-License-Identifier: Apache-2.0
# Cases of openacc, cuda and hip on a simulated GPU (simulated_cuda.c). For openacc and cuda it runs the program's PTX,
# translated to C. For hip it runs the source of the kernels, compiled for the host, and not the code objects of the
# program. Pictures have the bits of the scalar kernel. If the GPU is missing or fails, the program prints one line and
# exits with the right code. tests/cases.sh runs the cases with BIN SOURCE GPU COMPILER PYTHON. GPU is a folder, whose name
# ends with the backend: the case `driver` makes the simulated GPU's driver in it, for the other cases.
backend=${3##*/}
bin=$1
source=$2
gpu=$3
compiler=$4
python=$5
cp "$source"/params*.dat .
unset CUDA_VISIBLE_DEVICES
export LD_LIBRARY_PATH=$gpu
# bulb OPTION...: renders on the GPU.
bulb() { "$bin/mandelbulb" paramsBulb.dat --size 60x40 --backend $backend "$@"; }
# seconds NAME: prints the time NAME of a.json.
seconds() { sed -n "s/.*\"$1\": \([0-9.e-]*\),\{0,1\}$/\1/p" a.json; }
wrote=nvcc  # the compiler of the backend's PTX
[ $backend != openacc ] || wrote=gcc
library=libcuda.so.1
vendor=NVIDIA
refusal="NVIDIA's driver, CUDA 11.4, does not load the kernels, which need CUDA [0-9.]* or newer"
renamed=()  # options of the compiler that rename the driver's functions
[ $backend = openacc ] || export SIMULATED_CAPABILITY=90
# kernels FOLDER: writes the kernels of a driver, FOLDER/kernels.h.
kernels() { "$python" "$source/tests/gpu/ptx_to_c.py" $wrote "$bin/mandelbulb" >"$1/kernels.h"; }
# mutants FOLDER: writes mutants of the kernels, which round an addition differently.
mutants() {
    local register='((r|fd)[0-9]+)' real='\(\(double\)((r|fd)[0-9]+)\)'
    sed -E "s/^\{ $register = $real \\+ $real;/{ \\1 = fma(\\3, 1.0000000000000002, \\5);/" "$gpu/kernels.h" >"$1/kernels.h"
    cmp -s "$gpu/kernels.h" "$1/kernels.h" && fail "the mutants are the same kernels"
}
# driver FOLDER [SOURCE]: builds a driver, FOLDER/$library. Without SOURCE, it simulates a GPU that runs the kernels of
# FOLDER/kernels.h.
driver() {
    "$compiler" -x c -std=gnu11 -O1 -ffp-contract=off -fno-math-errno -w -shared -fPIC -I"$1" "${renamed[@]}" \
        "${2:-$source/tests/gpu/simulated_cuda.c}" -x none $(ls "$1"/*.o 2>/dev/null) -lm -o "$1/$library"
}

if [ $backend = hip ]; then
    library=libamdhip64.so.7
    vendor=AMD
    refusal="AMD's driver, HIP 6.2, does not load the kernels, which need a GPU gfx90a, gfx942"
    names=$(sed -nE 's/.*"(cu\w+)", "(hip\w+)".*/\1=\2/p' "$source/core/gpu/driver.cpp")
    renamed=(-DSIMULATED_AMD $(sed 's/^/-D/' <<<"$names"))
    # kernels FOLDER [OPTION...]: compiles the kernels for the host, with more options of the compiler.
    kernels() {
        local folder=$1 file
        for file in "$bin"/../backends/hip/loops_*.cu; do
            "$compiler" -x c++ -std=c++17 -O1 -ffp-contract=off -fno-math-errno -fno-trapping-math -w -Wno-psabi -fPIC \
                "-I$source" -include "$source/tests/gpu/host_words.h" "${@:2}" \
                -c "$file" -o "$folder/$(basename "$file").o" || return 1
        done
        nm "$folder"/*.o | awk '$2 == "T" { print $3 }' >names
        {
            printf '#include <stdint.h>\n#include <string.h>\nstatic unsigned threads_of_block;\n'
            sed 's/.*/void &(uint64_t);/' names
            echo 'static const struct { const char* name; void* run; } kernels[] = {'
            sed 's/.*/{"&", &},/' names
            echo '};'
            echo 'static const struct { const char* name; void* at; uint64_t bytes; } variables[] = {{0}};'
        } >"$folder/kernels.h"
    }
    mutants() { kernels "$1" -ffast-math; }
fi

# Several runs of this case may use the folder at once. Therefore each file is made elsewhere and moved into it when
# complete.
test_driver() {
    local new
    mkdir -p "$gpu"
    new=$(mktemp -d -p "$gpu")
    kernels "$new" || fail "making the kernels"
    driver "$new" || fail "building the driver"
    mv "$new"/* "$gpu"
    rmdir "$new"
}

# In exact mode the GPU gives the scalar kernel's bits and does the same work.
test_bits() {
    local scene precision draw
    sed 's/^0 4.0 8.0/0 4.0 7.5/' paramsBulb.dat >power.dat
    sed 's/^2 0.5 1/-1.5 0.5 1/' paramsBox.dat >scale.dat
    for scene in "bulb power.dat" "box scale.dat" "julia paramsJulia.dat" "bulb paramsBulb.dat" "box paramsBox.dat"; do
        for precision in float double; do
            draw="$bin/render --fractal $scene --size 170x131 --precision $precision"
            expect 0 $draw --backend $backend --output gpu.exr --stats gpu.json
            expect 0 $draw --backend openmp --simd-width 1 --output cpu.exr --stats cpu.json
            same_picture gpu.exr cpu.exr
            [ "$(grep -A3 '"work"' gpu.json)" = "$(grep -A3 '"work"' cpu.json)" ] || fail "the GPU does other work: $scene"
        done
    done
    grep -q '"name": "Simulated K40 number 0"' gpu.json || fail "the result file does not name the GPU"
    [ $backend = openacc ] || [ "$(grep -c '"registers": 100,' gpu.json)" = 1 ] || fail "registers: $(cat gpu.json)"
    [ $backend != cuda ] || grep -qaF .nv.info.mandelmarch_cuda_draw_mandelbulb_float_fast "$bin/mandelbulb" || fail "no machine code"
    expect 0 $draw --backend $backend --mode fast --output fast.exr
    other_picture fast.exr cpu.exr

    # Negative control: on a simulated GPU with mutants of the kernels, the picture is another one.
    mkdir mutant
    mutants mutant
    driver mutant || fail "building the mutant"
    LD_LIBRARY_PATH=$PWD/mutant expect 0 $draw --backend $backend --output mutant.exr
    other_picture mutant.exr cpu.exr
}

# In the stats, `kernel` is the time by the GPU's clock. It is the number of kernels, because each takes a simulated
# second. `host` is the wall time of the launches.
test_clock() {
    expect 0 bulb --mode exact --output a.png --stats a.json
    silent
    [ "$(seconds kernel)" = 1.0 ] || fail "kernel is $(seconds kernel) s, not the GPU's second"
    [ "$(seconds host)" != 1.0 ] || fail "host is the GPU's time"
    # Negative control: if the GPU has no clock, openacc's times are wall times.
    [ $backend = openacc ] || return
    SIMULATED_CLOCK=0 expect 0 bulb --mode exact --output a.png --stats a.json
    [ "$(seconds kernel)" != 1.0 ] || fail "kernel is a second without a clock"
}

# A trial takes no time of its own: in openacc its two pictures are part of the picture's launch; the others launch them at the
# same time.
test_trial() {
    local launches=3
    [ $backend != openacc ] || launches=1
    expect 0 bulb --mode fast --output a.png --stats a.json
    [ "$(seconds kernel)" = $launches.0 ] || fail "kernel is $(seconds kernel) s, not the $launches of as many launches"
    [ "$(seconds trial)" = 0.0 ] || fail "trial is $(seconds trial) s"
    expect 0 bulb --mode fast --without trial --output b.png --stats a.json
    [ "$(seconds kernel)" = 1.0 ] || fail "kernel is $(seconds kernel) s without a trial"
    same_picture a.png b.png
}

# The picture has slightly fewer pixels than a band, 16 for each of 15 x 2048 threads. If a watchdog ends long launches, a
# band has 2^18, and the picture two bands. Each band takes two launches of a second, one of them for cones.
test_bands() {
    large() {
        "$bin/mandelbulb" paramsBulb.dat --size 700x690 --backend $backend --mode fast --precision float --without trial \
            --output a.png --stats a.json
    }
    expect 0 large
    [ "$(seconds kernel)" = 2.0 ] || fail "kernel is $(seconds kernel) s, not that of one band"
    SIMULATED_WATCHED=1 expect 0 large
    [ "$(seconds kernel)" = 4.0 ] || fail "kernel is $(seconds kernel) s, not that of two bands under a watchdog"
}

test_little_memory() {
    SIMULATED_MEMORY=40000 expect 1 bulb --output b.png
    says 'Simulated K40 number 0 has .* bytes of memory free'
    [ -e b.png ] && fail "a picture from a GPU that failed"
    SIMULATED_MEMORY=80000 expect 0 bulb --output c.png  # in many bands
}

# The driver locks the memory of a device's pictures once, at the second picture, and not for a single picture.
test_locks() {
    export SIMULATED_LOCKS=$PWD/locks
    pictures() { "$bin/bench" --backend $backend --fractal bulb --precision float --size 60x40 --repetitions "$@" --no-peaks >out 2>&1 || fail "$(cat out)"; }
    : >locks
    expect 0 bulb --output a.png
    [ -s locks ] && fail "for one picture: $(cat locks)"
    pictures 5
    [ "$(cat locks)" = locked ] || fail "for many pictures: $(cat locks)"
    : >locks
    SIMULATED_FAULT=lock pictures 2
    [ -s locks ] && fail "by a driver that refuses: $(cat locks)"
}

# The picture does not depend on the number of warps that render at once. openacc has the host as another device.
test_resident_warps() {
    local rows=10
    [ $backend != openacc ] || rows=20
    "$bin/bench" --backend $backend --study resident-warps --size 60x40 --precision float --repetitions 1 --no-peaks >warps 2>&1 ||
        fail "warps: $(cat warps)"
    [ "$(grep -c '^b.*resident-warps=.* same bits' warps)" = $rows ] || fail "five numbers of warps, two fractals: $(cat warps)"
}

# Devices 0 to 2 are the simulated GPUs. With openacc, device 3 is the host.
test_devices() {
    export SIMULATED_GPUS=3
    expect 0 bulb --device 2 --output a.png --stats a.json
    silent
    grep -q '"name": "Simulated K40 number 2"' a.json || fail "--device 2 chose $(grep name a.json)"
    if [ $backend = openacc ]; then
        expect 0 bulb --device 3 --output a.png
        says 'runs on the host, one thread: instead of a GPU'
        expect 77 bulb --device 4 --output b.png
        says 'there is no device 4, only 0 to 3'
        unset SIMULATED_GPUS
        backend=auto expect 0 bulb --output a.png
        says '^drawing with openacc \(GPU Simulated K40 number 0\)$'
        return
    fi
    expect 77 bulb --device 3 --output b.png
    says 'there is no device 3, only 0 to 2'
    SIMULATED_GPUS=0 expect 77 bulb --output b.png
    says "no $vendor GPU is here"
    [ $backend = hip ] && return
    SIMULATED_CAPABILITY=20 expect 77 bulb --output b.png
    says 'of compute capability .* and up, device 0 has 20'
}

# On failures of openacc, gcc's run-time library prints its own message and ends the device process.
test_failures() {
    local fault faults=('launch:launching a kernel: simulated error \(701\)'
        'lost:running a kernel: unspecified launch failure \(719\)' 'timeout:running a kernel: the launch timed out')
    [ $backend != openacc ] || faults=('launch:cuLaunchKernel error' 'lost:.*unspecified launch failure' 'timeout:.*launch timed out')
    for fault in "${faults[@]}"; do
        SIMULATED_FAULT=${fault%%:*} expect 1 bulb --output b.png
        says "($backend|last words: libgomp): ${fault#*:}"
        [ -e b.png ] && fail "a picture from a GPU that failed"
    done
    [ $backend != openacc ] || return
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
