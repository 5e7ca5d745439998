#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BIN SOURCE CORPUS SECONDS FUZZER...: runs each fuzzer for SECONDS, one per core at a time, starting from the
# official parameter files, small pictures, a short path and a small result. Inputs that cause a failure are kept in
# CORPUS/FUZZER.
set -uo pipefail
bin=$1
source=$2
corpus=$3
seconds=$4
shift 4
seeds=$corpus/seeds
mkdir -p "$seeds" || exit 1
cp "$source"/params*.dat "$source"/tests/fuzz/result.json "$seeds"/
for format in bmp png exr; do
    "$bin/render" --fractal box "$source/paramsBox.dat" --size 5x3 --backend openmp --output "$seeds/small.$format" ||
        exit 1
done

cat >"$seeds/path.json" <<'END'
{"format": "mandelmarch path 1", "fractal": "mandelbulb", "seed": 1, "frames_per_second": 30,
"scene": {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2},
"frames": [{"location": [4, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1},
{"location": [4, 3, 3.5], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1, "detail": -3.5, "shape": [0, 4, 7.5],
"iterations": 50, "escape": 90, "colouring": 1, "brightness": 2}]}
END

# fuzz NAME: runs one fuzzer.
fuzz() {
    mkdir -p "$corpus/$1" && cd "$corpus/$1" || return 1
    "$bin/$1_fuzz" -max_total_time="$seconds" -max_len=4096 -timeout=20 -rss_limit_mb=2560 -print_final_stats=1 . \
        "$seeds" >"$corpus/$1.log" 2>&1
}

declare -A running
for name in "$@"; do
    while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do sleep 0.2; done
    fuzz "$name" &
    running[$name]=$!
done
failures=0
for name in "$@"; do
    if wait "${running[$name]}"; then
        echo "$name: $(sed -n 's/stat::number_of_executed_units: *//p' "$corpus/$name.log") inputs"
    else
        failures=$((failures + 1))
        echo "FAILED: $name, in $corpus/$name:"
        tail -n 60 "$corpus/$name.log"
    fi
done
exit $((failures > 0))
