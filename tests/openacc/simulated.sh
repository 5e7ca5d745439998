# SPDX-License-Identifier: Apache-2.0
# Sourced by the tests of openacc and cuda on a simulated GPU (simulated_cuda.c), which runs a program's PTX, translated
# to C. Needs the variables backend, bin, source (the project's folder) and compiler. Goes to an empty folder with the
# official parameter files.
. "$source/tests/failures.sh"
cp "$source"/params*.dat "$folder"
cd "$folder"
unset CUDA_VISIBLE_DEVICES

# expect CODE LINES PATTERN ARGUMENT...: checks mandelbulb's exit code and stderr.
expect() {
    local code=$1 lines=$2 pattern=$3 got
    shift 3
    "$bin/mandelbulb" paramsBulb.dat --size 60x40 --backend "$backend" "$@" 2>stderr
    got=$?
    [ $got = "$code" ] || fail "exit code $got, expected $code: $*"
    [ "$(grep -c . stderr)" = "$lines" ] || fail "$lines lines expected on stderr: $* : $(cat stderr)"
    grep -q "$pattern" stderr || [ -z "$pattern" ] || fail "stderr does not say '$pattern': $(cat stderr)"
}

# driver FOLDER [SOURCE]: builds FOLDER/libcuda.so.1, by default the GPU that runs the kernels of FOLDER/kernels.h.
driver() {
    "$compiler" -x c -std=gnu11 -O1 -ffp-contract=off -fno-math-errno -w -shared -fPIC -I"$1" \
        "${2:-$source/tests/openacc/simulated_cuda.c}" -lm -o "$1/libcuda.so.1"
}

# check_bits "FRACTAL FILE"...: in exact mode the PTX gives the scalar kernel's bits and does the same work, for these
# scenes and two others. Leaves the last one's stats in gpu.json.
check_bits() {
    local scene precision draw
    sed 's/^0 4.0 8.0/0 4.0 7.5/' paramsBulb.dat >power.dat
    sed 's/^2 0.5 1/-1.5 0.5 1/' paramsBox.dat >scale.dat
    for scene in "bulb power.dat" "box scale.dat" "$@"; do
        for precision in float double; do
            draw="$bin/render --fractal $scene --size 170x131 --precision $precision"
            $draw --backend "$backend" --output gpu.exr --stats gpu.json || fail "$draw"
            $draw --backend openmp --simd-width 1 --output cpu.exr --stats cpu.json || fail "$draw"
            "$bin/imgdiff" gpu.exr cpu.exr >difference || fail "the PTX draws other bits: $scene $precision: $(cat difference)"
            [ "$(grep -A3 '"work"' gpu.json)" = "$(grep -A3 '"work"' cpu.json)" ] || fail "the PTX does other work: $scene"
        done
    done
    grep -q '"name": "Simulated K40 number 0"' gpu.json || fail "the result file does not name the GPU"
    $draw --backend "$backend" --mode fast --output fast.exr || fail "fast mode"
    "$bin/imgdiff" fast.exr cpu.exr >/dev/null && fail "fast mode has exact mode's bits"

    # Negative control: a simulated GPU that rounds an addition differently.
    mkdir twin
    sed -E 's/^((r|fd)[0-9]+) = \(\(double\)((r|fd)[0-9]+)\) \+ \(\(double\)((r|fd)[0-9]+)\);/\1 = fma(\3, 1.0000000000000002, \5);/' \
        kernels.h >twin/kernels.h
    cmp -s kernels.h twin/kernels.h && fail "the twin is no twin"
    driver twin || fail "building the twin"
    LD_LIBRARY_PATH=$folder/twin $draw --backend "$backend" --output twin.exr || fail "the twin does not draw"
    "$bin/imgdiff" twin.exr cpu.exr >/dev/null && fail "the twin that rounds otherwise was not seen"
}

# seconds NAME: returns a time of a.json.
seconds() { sed -n "s/.*\"$1\": \([0-9.e-]*\),\{0,1\}$/\1/p" a.json; }
