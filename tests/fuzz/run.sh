#!/usr/bin/env bash
# run.sh FUZZER SOURCE CORPUS SECONDS: fuzzes for so long, from the official parameter files, a small picture and a short
# path.
set -euo pipefail
mkdir -p "$3"
cp "$2"/params*.dat "$3"/
printf 'BM\x5a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x02\0\0\0\x01\0\x18\0%032d' 0 >"$3/small.bmp"
cat >"$3/path.json" <<'END'
{"format": "mandelmarch path 1", "fractal": "mandelbulb", "seed": 1, "frames_per_second": 30,
"scene": {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2},
"frames": [{"location": [4, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1},
{"location": [4, 3, 3.5], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1, "detail": -3.5, "shape": [0, 4, 7.5],
"iterations": 50, "escape": 90, "colouring": 1, "brightness": 2}]}
END
cd "$3"
exec "$1" -max_total_time="$4" -max_len=4096 -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 "$3"
