# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE SHIM. On an OpenCL device with a fault, programs print one clear line,
# exit with the right code, leave no picture and do not hang. On a device that only lacks features, the picture is the
# same.
bin=$1
source=$2
shim=$3
has_device opencl || exit 77

draw() {  # draw FAULT OPTION...: renders with this fault
    MANDELMARCH_FAULT=$1 MANDELMARCH_DEVICE_TIMEOUT=${patience:-100} LD_PRELOAD=$shim timeout 60 "$bin/render" \
        --fractal box "$source/paramsBox.dat" --backend opencl --size "${size:-40x30}" --output picture.exr "${@:2}"
}

fails() {  # fails FAULT CODE TEXT OPTION...: expects this exit code and message
    expect "$2" draw "$1" "${@:4}"
    says "$3"
    [ ! -e picture.exr ] || fail "$1: a picture"
}

both() {  # both FAULT OPTION...: renders without and with the fault
    expect 0 draw none "${@:2}"
    mv picture.exr expected.exr
    expect 0 draw "$@"
}

same() {  # same FAULT OPTION...: expects the picture without the fault
    both "$@"
    same_picture expected.exr picture.exr
}

test_failures() {
    fails dies 1 "backend opencl: .*out of resources, or died"
    patience=1 fails hangs 1 "no answer within 1 s"
    fails memory 1 "out of memory"
    fails compiler 1 "no compiler"
}

test_absent() {
    fails absent 77 "no OpenCL device"
    fails no-double 77 "has no double" --precision double
    fails no-double-inexact 77 "divides inexactly" --precision float
    fails none 77 "there is no device 9" --device 9
    fails none 2 "no vector length" --simd-width 3
}

test_limited() {
    same none --precision float
    same no-double --precision float
    same inexact --precision float  # division and square root are computed in double
    both inexact-liar --precision float
    other_picture expected.exr picture.exr  # negative control: a device that hides its inexact division
    size=300x200
    same small-buffers --precision double  # in bands
    same small-buffers --precision float
}

# On a device that calls itself a GPU of NVIDIA, native functions draw the fast pictures in float, and no others.
test_native_words() {
    local visible
    both nvidia --precision float --mode fast --simd-width 1
    other_picture expected.exr picture.exr
    visible=$(sed -n 's/.* \([0-9]*\) by more than .*/\1/p' difference)
    [ "$visible" -le 12 ] || fail "$visible of 1200 pixels differ visibly"
    same nvidia --precision double --mode fast --simd-width 1
    same nvidia --precision float --mode exact --simd-width 1
}

# A wrong picture fails verification. bench reports the failure and times the other backends.
test_garbage() {
    MANDELMARCH_MISCONDUCT="map garbage" LD_PRELOAD=$shim "$bin/bench" --fractal box --precision float --mode exact \
        --size 32x32 --repetitions 1 --no-peaks --json bench.json >stdout 2>stderr
    [ $? = 1 ] || fail "another exit code than 1: $(cat stderr)"
    prints 'float *exact *opencl .*FAILED'
    prints 'float *exact *openmp .*same bits'
    [ -s bench.json ] || fail "no result"
}

test_caches() {
    POCL_CACHE_DIR='' expect 0 "$bin/render" --list-devices
    prints '^opencl *0: '
    local home
    for home in /proc/nope /dev/null; do
        HOME=$home XDG_CACHE_HOME=$home expect 0 env -u POCL_CACHE_DIR "$bin/render" --fractal box --size 40x30 \
            "$source/paramsBox.dat" --backend opencl --output home.bmp
    done
}
