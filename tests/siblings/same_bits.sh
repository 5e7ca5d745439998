#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# same_bits.sh BIN_A BIN_B: the programs in BIN_A and BIN_B are built by different compilers. In exact mode they give
# the same bytes and the same bits of depth. Fast mode is the negative control.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for fractal in mandelbulb:paramsBulb.dat mandelbox:paramsBox.dat; do
    for precision in double float; do
        for pack in 0 1; do
            for side in "$1" "$2"; do
                "$side/${fractal%%:*}" "${fractal##*:}" --size 333x217 --backend openmp --precision $precision \
                    --simd-width $pack --output "$folder/$([ "$side" = "$1" ] && echo a || echo b).exr"
            done
            "$1/imgdiff" "$folder/a.exr" "$folder/b.exr"
        done
    done
done
"$1/mandelbox" paramsBox.dat --size 333x217 --backend openmp --mode fast --precision float --output "$folder/b.exr"
if "$1/imgdiff" "$folder/a.exr" "$folder/b.exr"; then
    echo "the comparison cannot fail"
    exit 1
fi
