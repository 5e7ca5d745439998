# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts with cases of openacc, cuda and hip on a simulated GPU (simulated_cuda.c), which runs a
# program's PTX, translated to C. tests/cases.sh runs these cases with BIN SOURCE GPU COMPILER PYTHON. GPU is a folder:
# the case `driver` makes the simulated GPU's driver in it, for the other cases. The script must set the variables
# `backend`, the name of the backend; `wrote`, the compiler of its PTX; `library`, the driver's file; `most_calls` and
# `never_again`, for test_calls.
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
# own FUNCTION: prints the name that a function of NVIDIA's driver has in the backend's.
own() { echo "$1"; }
renamed=()  # options of the compiler that rename these functions
# kernels FOLDER: writes the kernels of a driver, FOLDER/kernels.h.
kernels() { "$python" "$source/tests/openacc/ptx_to_c.py" $wrote "$bin/mandelbulb" >"$1/kernels.h"; }
# mutants FOLDER: writes mutants of the kernels, which round an addition differently.
mutants() {
    local register='((r|fd)[0-9]+)' real='\(\(double\)((r|fd)[0-9]+)\)'
    sed -E "s/^$register = $real \\+ $real;/\\1 = fma(\\3, 1.0000000000000002, \\5);/" "$gpu/kernels.h" >"$1/kernels.h"
    cmp -s "$gpu/kernels.h" "$1/kernels.h" && fail "the mutants are the same kernels"
}
# driver FOLDER [SOURCE]: builds a driver, FOLDER/$library. Without SOURCE, it simulates a GPU that runs the kernels of
# FOLDER/kernels.h.
driver() {
    "$compiler" -x c -std=gnu11 -O1 -ffp-contract=off -fno-math-errno -finstrument-functions -w -shared -fPIC -I"$1" \
        "${renamed[@]}" "${2:-$source/tests/openacc/simulated_cuda.c}" -x none $(ls "$1"/*.o 2>/dev/null) -lm \
        -o "$1/$library"
}

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
    [ $backend = openacc ] || [ "$(grep -c '"registers": 100,' gpu.json)" = 3 ] || fail "registers: $(cat gpu.json)"
    expect 0 $draw --backend $backend --mode fast --output fast.exr
    other_picture fast.exr cpu.exr

    # Negative control: on a simulated GPU with mutants of the kernels, the picture is another one.
    mkdir mutant
    mutants mutant
    driver mutant || fail "building the mutant"
    LD_LIBRARY_PATH=$PWD/mutant expect 0 $draw --backend $backend --output mutant.exr
    other_picture mutant.exr cpu.exr
}

# In the stats, `kernel` is the time by the GPU's clock. It is 3 s, because each of three kernels takes a simulated
# second. `host` is the wall time of the launches.
test_clock() {
    expect 0 bulb --mode exact --output a.png --stats a.json
    silent
    [ "$(seconds kernel)" = 3.0 ] || fail "kernel is $(seconds kernel) s, not the GPU's 3"
    [ "$(seconds host)" != 3.0 ] || fail "host is the GPU's time"
    # Negative control: if the GPU has no clock, openacc's times are wall times.
    [ $backend = openacc ] || return
    SIMULATED_CLOCK=0 expect 0 bulb --mode exact --output a.png --stats a.json
    [ "$(seconds kernel)" != 3.0 ] || fail "kernel is 3 s without a clock"
}

# The picture has slightly more than 2^19 pixels. It is rendered in one band or, if a watchdog ends long launches, in
# three. Each band takes four launches of a second, one of them for cones.
test_bands() {
    large() {
        "$bin/mandelbulb" paramsBulb.dat --size 750x700 --backend $backend --mode fast --precision float --without trial \
            --output a.png --stats a.json
    }
    expect 0 large
    [ "$(seconds kernel)" = 4.0 ] || fail "kernel is $(seconds kernel) s, not that of four kernels on one band"
    SIMULATED_WATCHED=1 expect 0 large
    [ "$(seconds kernel)" = 12.0 ] || fail "kernel is $(seconds kernel) s, not that of four kernels on three bands under a watchdog"
}

test_little_memory() {
    SIMULATED_MEMORY=40000 expect 1 bulb --output b.png
    says 'Simulated K40 number 0 has .* bytes of memory free'
    [ -e b.png ] && fail "a picture from a GPU that failed"
    SIMULATED_MEMORY=80000 expect 0 bulb --output c.png  # in many bands
}

# called ROUNDS: counts the driver's calls in a run of bench: a file with a line `NAME NUMBER` for each function.
called() {
    rm -f called
    SIMULATED_CALLS=$PWD/called MANDELMARCH_BACKENDS=$backend expect 0 "$bin/bench" --backend $backend --fractal bulb \
        --precision float --mode fast --size 60x40 --repetitions "$1" --no-peaks
    sort called | uniq -c | awk '{ print $2, $1 }' >"called$1"
}
# calls FUNCTION FILE...: prints how often a function (`.*`: any) was called.
calls() { awk -v name="^$1\$" '$1 ~ name { sum += $2 } END { print sum + 0 }' "$2"; }

# One more picture takes three launches and at most $most_calls calls of the driver. None of them asks for free memory,
# makes an event or, on cuda and hip, allocates memory.
test_calls() {
    local more name
    called 2
    called 12
    more=$(($(calls "$(own cuLaunchKernel)" called12) - $(calls "$(own cuLaunchKernel)" called2)))
    [ $more -ge 30 ] || fail "$more launches in ten more rounds"
    [ $((3 * ($(calls '.*' called12) - $(calls '.*' called2)))) -le $((most_calls * more)) ] ||
        fail "over $most_calls calls a picture, in $((more / 3)) pictures: $(diff called2 called12)"
    for name in "$(own cuMemGetInfo_v2)" "$(own cuEventCreate)" $never_again; do
        [ "$(calls $name called12)" = "$(calls $name called2)" ] || fail "$name is called again: $(diff called2 called12)"
        [ "$(calls $name called2)" -gt 0 ] || fail "negative control: $name is never called"
    done
}
