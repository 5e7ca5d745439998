#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh PRESET [TARGET...]: configures and builds the preset, all of it where no target is named. Warnings are errors where CI
# is set. SPIRV: a folder of modules that need not be made once more.
set -euo pipefail
preset=$1
shift
[ $# -gt 0 ] || set -- all
cmake --preset "$preset" ${CI:+-DMANDELMARCH_WERROR=ON} ${SPIRV:+-DMANDELMARCH_SPIRV="$SPIRV"} >/dev/null
cmake --build --preset "$preset" --target "$@"
