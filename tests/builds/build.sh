#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh PRESET [TARGET...]: configures the preset and builds the targets (default: all). Warnings are errors if CI is
# set. If the environment variable SPIRV names a folder, its SPIR-V modules are used instead of building them.
set -euo pipefail
preset=$1
shift
[ $# -gt 0 ] || set -- all
cmake --preset "$preset" ${CI:+-DMANDELMARCH_WERROR=ON} ${SPIRV:+-DMANDELMARCH_SPIRV="$SPIRV"} >/dev/null
cmake --build --preset "$preset" --target "$@"
