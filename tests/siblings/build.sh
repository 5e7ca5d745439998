#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh PRESET [TARGET...]: configures and builds the preset (default: all targets). Warnings are errors if CI is
# set. Environment variable SPIRV: a folder with SPIR-V modules to use instead of building them.
set -euo pipefail
preset=$1
shift
[ $# -gt 0 ] || set -- all
cmake --preset "$preset" ${CI:+-DMANDELMARCH_WERROR=ON} ${SPIRV:+-DMANDELMARCH_SPIRV="$SPIRV"} >/dev/null
cmake --build --preset "$preset" --target "$@"
