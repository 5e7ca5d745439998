#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cross.sh BIN ARCH: builds render for another processor and compares its pictures, made by emulation, with those of
# BIN/render. If the processor's libraries cannot be downloaded, exits with 77, or with 1 if CI is set.
set -euo pipefail
arch=$2
build=build/cross/$arch/build
tools/cross_root "$arch" || exit "$([ -n "${CI:-}" ] && echo 1 || echo 77)"
# A compiler cache can answer CMake's question for the compiler's folders with those of another processor.
unset CMAKE_CXX_COMPILER_LAUNCHER
cmake -S . -B "$build" -G Ninja --toolchain cmake/cross.cmake -DMANDELMARCH_CROSS="$arch" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON -DMANDELMARCH_BACKENDS=openmp -DMANDELMARCH_TESTS=OFF \
    ${CI:+-DMANDELMARCH_WERROR=ON} >/dev/null
cmake --build "$build" --target render
emulator=qemu-${arch/arm64/aarch64}
bash tests/builds/same_bits.sh "$1" "$build/bin" \
    "$(command -v "$emulator-static" || command -v "$emulator")" -L "build/cross/$arch/root"
