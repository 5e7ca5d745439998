#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# faults_test.sh BIN SHIM ROOT: on OpenCL devices with faults, programs print one clear line, exit with the right code,
# leave no picture and do not hang. Devices with limited features give the same picture.
set -uo pipefail
bin=$1
shim=$2
root=$3
. "$root/tests/failures.sh"
cd "$folder" || exit 1

draw() {  # draw FAULT OPTION...: renders with this fault
    local fault=$1
    shift
    MANDELMARCH_FAULT=$fault MANDELMARCH_DEVICE_TIMEOUT=${patience:-100} LD_PRELOAD=$shim timeout 60 "$bin/render" --fractal box \
        "$root/paramsBox.dat" --backend opencl --size "${size:-40x30}" --output picture.exr "$@" 2>stderr
}

fails() {  # fails FAULT CODE TEXT OPTION...: expects this exit code and message
    local fault=$1 code=$2 text=$3
    shift 3
    rm -f picture.exr
    draw "$fault" "$@"
    local got=$?
    if [ $got != "$code" ] || [ "$(wc -l <stderr)" != 1 ] || ! grep -q "$text" stderr || [ -e picture.exr ]; then
        fail "$fault $*: exit code $got, expected $code; stderr: $(cat stderr)"
    fi
}

same() {  # same FAULT OPTION...: expects the picture without the fault
    local fault=$1
    shift
    if ! draw none "$@" || ! mv picture.exr expected.exr || ! draw "$fault" "$@" ||
        ! "$bin/imgdiff" expected.exr picture.exr >difference; then
        fail "$fault $*: $(cat stderr difference)"
    fi
}

differs() {  # differs FAULT OPTION...: expects another picture
    local fault=$1
    shift
    if ! draw none "$@" || ! mv picture.exr expected.exr || ! draw "$fault" "$@" ||
        "$bin/imgdiff" expected.exr picture.exr >difference; then
        fail "$fault $*: the same picture, expected another; $(cat stderr)"
    fi
}

fails dies 1 "backend opencl: .*out of resources, or died"
patience=1 fails hangs 1 "no answer within 1 s"
fails memory 1 "out of memory"
fails compiler 1 "no compiler"
fails absent 77 "no OpenCL device"
fails no-double 77 "has no double" --precision double
fails no-double-inexact 77 "divides inexactly" --precision float
fails none 77 "there is no device 9" --device 9
fails none 2 "no vector length" --simd-width 3
same none --precision float
same no-double --precision float
same inexact --precision float  # division and square root are computed in double
differs inexact-liar --precision float  # negative control: a device that hides its inexact division gives other bits
size=300x200
same small-buffers --precision double  # in bands
same small-buffers --precision float
finish
