# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE API SHIM: OpenCL devices that lack features, and caches that cannot be
# written.
. "$(dirname "$script")/drivers.sh"

test_absent() {
    refused 77 "no OpenCL device" absent
    refused 77 "has no double" no_double --precision double
    refused 77 "there is no device 9" none --device 9
    refused 2 "no vector length" none --simd-width 3
}

test_features() {
    same no_double --precision float
    same inexact --precision float  # division and square root are computed in double
    refused 77 "divides inexactly" no_double_inexact --precision float
    both inexact_liar --precision float
    other_picture expected.exr picture.exr  # negative control: a device that hides its inexact division
    size=300x200 same small_buffers  # in bands
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

test_caches() {
    POCL_CACHE_DIR='' expect 0 "$bin/render" --list-devices
    prints '^opencl *0: '
    local home
    unset POCL_CACHE_DIR
    for home in /proc/nope /dev/null; do HOME=$home XDG_CACHE_HOME=$home expect 0 draw none; done
}
