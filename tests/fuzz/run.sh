#!/usr/bin/env bash
# run.sh FUZZER SOURCE CORPUS SECONDS: fuzzes for so long, from the official parameter files and small pictures.
set -euo pipefail
mkdir -p "$3"
cp "$2"/params*.dat "$3"/
printf 'BM\x5a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x02\0\0\0\x01\0\x18\0%032d' 0 >"$3/small.bmp"
cd "$3"
exec "$1" -max_total_time="$4" -max_len=4096 -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 "$3"
