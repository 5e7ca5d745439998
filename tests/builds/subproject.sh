#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# subproject.sh SOURCE: mandelmarch as a subproject does not change the settings of its parent project. Negative
# control: a changed setting is detected. The parent chooses the backends.
set -uo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
configure() { cmake -G Ninja -S "$1/tests/builds/subproject" -B "$folder/$2" -DMANDELMARCH_SOURCE="$1" "${@:3}" >"$folder/log" 2>&1; }
configure "$1" plain || { cat "$folder/log"; exit 1; }
configure "$1" changed -DCHANGED=ON && { echo "a changed setting is not detected"; exit 1; }
grep -q "the parent's settings have changed" "$folder/log" || { cat "$folder/log"; exit 1; }
configure "$1" few -DMANDELMARCH_BACKENDS=vulkan,stdpar || { cat "$folder/log"; exit 1; }
grep -q "backend opencl: not built" "$folder/log" && ! grep -q "backend \(openmp\|vulkan\): not built" "$folder/log" ||
    { cat "$folder/log"; exit 1; }
configure "$1" nonsense -DMANDELMARCH_BACKENDS=vulkan,nonsense && { echo "an unknown backend is not seen"; exit 1; }
grep -q "MANDELMARCH_BACKENDS: 'nonsense' given, expected all or some of reference" "$folder/log" ||
    { cat "$folder/log"; exit 1; }
echo "a parent's settings stay"
