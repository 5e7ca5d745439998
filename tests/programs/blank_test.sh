#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# blank_test.sh BIN SOURCE: in a build folder whose path contains a blank, the configuration gives the reason why
# OpenACC is left out. In any other folder it does not.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(blank LANGUAGES CXX)
include($2/cmake/Nvptx.cmake)
mandelmarch_offloads(openacc -fopenacc "acc parallel loop copyout(sums)")
END
for folder in "a b" ab; do
    cmake -S "$work" -B "$work/$folder" -DCMAKE_CXX_COMPILER=g++ >"$work/said"
    if grep -q "no offload compiler" "$work/said"; then exit 77; fi
    said=no
    if grep -q "openacc: '.*/a b' contains a blank" "$work/said"; then said=yes; fi
    [ "$folder $said" = "a b yes" ] || [ "$folder $said" = "ab no" ] || { cat "$work/said" >&2; exit 1; }
done
