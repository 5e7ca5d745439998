#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh PRESET [TARGET...]: configures and builds the preset, all of it where no target is named.
set -euo pipefail
preset=$1
shift
[ $# -gt 0 ] || set -- all
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target "$@"
