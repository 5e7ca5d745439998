#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# excess_precision_test.sh BIN SOURCE: the kernel source does not compile for 32-bit x86 with x87 arithmetic, which
# computes in a higher precision than the type's. With SSE2 arithmetic it does.
set -euo pipefail
[ "$(uname -m)" = x86_64 ] || exit 77
compile() {
    g++ -std=c++20 -m32 "$@" -DMM_REAL=float -DMM_REAL_IS_FLOAT=1 -fsyntax-only -x c++ - \
        <<<'#include "core/kernel/prelude/scalar.h"'
}
compile -I"$2" -msse2 -mfpmath=sse
if said=$(compile -I"$2" -mno-sse -mfpmath=387 2>&1); then
    echo "FAILED: x87 arithmetic compiles" >&2
    exit 1
fi
grep -q "higher precision than the type's" <<<"$said" || { echo "FAILED: $said" >&2; exit 1; }
