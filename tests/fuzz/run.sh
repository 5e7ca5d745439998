#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run.sh BIN SOURCE CORPUS FORMAT: runs the fuzzer of FORMAT for FUZZ_SECONDS (default 20), starting from the official
# parameter files, looks, places, schedules, small pictures, a short path and a small result. Inputs that cause a failure
# are kept in CORPUS/FORMAT.
set -euo pipefail
bin=$1
source=$2
corpus=$3/$4
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
cp "$source"/params*.dat "$source"/scenes/*.look "$source"/scenes/*.csv "$seeds"/
for schedule in 2 2:2.5 0s=2,60s=2.5 p8 p8:5 p0s=8,60s=5,120s=8; do echo -n "$schedule" >"$seeds/$schedule"; done
printf 'P2 # grey\n3 1 7\n0 3 7\n' >"$seeds/grey.pgm"
for format in bmp png exr ppm; do
    "$bin/render" --fractal box "$source/paramsBox.dat" --size 5x3 --backend openmp --output "$seeds/small.$format"
done
cat >"$seeds/path.json" <<'END'
{"format": "mandelmarch path 1", "fractal": "mandelbulb", "seed": 1, "frames_per_second": 30,
"scene": {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2},
"frames": [{"location": [4, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1},
{"location": [4, 3, 3.5], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1, "detail": -3.5, "shape": [0, 4, 7.5],
"iterations": 50, "escape": 90, "colouring": 1, "brightness": 2}]}
END
python3 - "$source/results/bench.json" >"$seeds/result.json" <<'END'
import json, sys
result = json.load(open(sys.argv[1], encoding="utf-8"))
row = next(row for row in result["rows"] if row["backend"] == "openmp")
row["samples"] = row["samples"][::4]
environment = result["environment"] | {"cpu": {"model": "CPU"}}
small = {name: environment[name] for name in ("git", "build", "cpu")} | {"backends": environment["backends"][1:2]}
print(json.dumps(result | {"environment": small, "warnings": ["w"], "peaks": result["peaks"][:1], "counts": [], "rows": [row]}))
END
mkdir -p "$corpus"
cd "$corpus"
if "$bin/fuzz" "$4" -max_total_time="${FUZZ_SECONDS:-20}" -max_len=4096 -timeout=20 -rss_limit_mb=2560 -print_final_stats=1 . "$seeds" \
    >"$corpus.log" 2>&1; then
    echo "$4: $(sed -n 's/stat::number_of_executed_units: *//p' "$corpus.log") inputs"
else
    echo "FAILED: $4, in $corpus:"
    tail -n 60 "$corpus.log"
    exit 1
fi
