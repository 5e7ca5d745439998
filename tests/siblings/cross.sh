#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cross.sh BIN ARCH: builds render for another processor and runs it by emulation. Exact pictures have the same bits as
# those of BIN/render. The negative control is fast mode in float.
set -euo pipefail
bin=$1
arch=$2
build=build/cross/$arch/build
cmake -S . -B "$build" -G Ninja --toolchain cmake/cross.cmake -DMANDELMARCH_CROSS="$arch" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON -DMANDELMARCH_BACKENDS=openmp -DMANDELMARCH_TESTS=OFF \
    ${CI:+-DMANDELMARCH_WERROR=ON} >/dev/null
cmake --build "$build" --target render
emulator=qemu-${arch/arm64/aarch64}
emulated=("$(command -v "$emulator-static" || command -v "$emulator")" -L "build/cross/$arch/root" "$build/bin/render")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# differ FRACTAL OPTION...: renders a picture with both programs. Returns true if any bit differs.
differ() {
    local options=(--fractal "mandel${1,}" "params$1.dat" --size 101x67 --backend openmp "${@:2}")
    "$bin/render" "${options[@]}" --output "$folder/here.exr"
    "${emulated[@]}" "${options[@]}" --output "$folder/there.exr"
    ! "$bin/imgdiff" "$folder/here.exr" "$folder/there.exr"
}
for fractal in Bulb Box; do
    for precision in float double; do
        for width in 0 1; do
            if differ $fractal --precision $precision --simd-width $width; then
                echo "FAILED: $arch: $fractal, $precision, --simd-width $width has other bits" >&2
                exit 1
            fi
        done
    done
done
if ! differ Bulb --precision float --mode fast; then
    echo "FAILED: the comparison cannot fail" >&2
    exit 1
fi
