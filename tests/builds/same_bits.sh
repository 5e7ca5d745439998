#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# same_bits.sh BIN OTHER [EMULATOR WORD...]: another compiler than BIN's built OTHER/render, for this processor or for
# the one that EMULATOR emulates. In exact mode it gives the same bits of colour and depth as BIN/render, and the same
# bytes of a BMP file. Fast mode is the negative control.
set -euo pipefail
here=("$1/render")
there=("${@:3}" "$2/render")
difference=$1/imgdiff
size=$([ $# = 2 ] && echo 333x217 || echo 101x67)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# draw SIDE ENDING FRACTAL OPTION...: renders SIDE.ENDING. SIDE is here or there.
draw() {
    local -n render=$1
    "${render[@]}" --fractal "mandel${3,}" "params$3.dat" --size "$size" --backend openmp "${@:4}" \
        --output "$folder/$1.$2"
}
# both ENDING FRACTAL OPTION...: renders here.ENDING and there.ENDING.
both() {
    echo "${@:2}"
    draw here "$@"
    draw there "$@"
}
for fractal in Bulb Box; do
    for precision in double float; do
        both bmp $fractal --precision $precision
        cmp "$folder/here.bmp" "$folder/there.bmp"
        for width in 0 1; do
            both exr $fractal --precision $precision --simd-width $width
            "$difference" "$folder/here.exr" "$folder/there.exr"
        done
    done
done
draw there exr Box --precision float --mode fast
if "$difference" "$folder/here.exr" "$folder/there.exr"; then
    echo "the comparison cannot fail"
    exit 1
fi
