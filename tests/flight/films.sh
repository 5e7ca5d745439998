# SPDX-License-Identifier: Apache-2.0
# Sourced by tests of flythrough, which get its path as their first argument: goes to an empty folder.
set -uo pipefail
program=$(realpath "$1")
. "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/../failures.sh"
cd "$folder" || exit 1
# run CODE ARGUMENTS...: runs flythrough and expects this exit code. On failure it must print one line on stderr; with
# codes 2 and 77 it must change no file.
run() {
    local code=$1 got before after
    shift
    before=$(find . -type f ! -name stderr ! -name stdout -printf '%p %s %T@\n' | sort)
    timeout 600 "$program" "$@" >stdout 2>stderr </dev/null
    got=$?
    [ $got = "$code" ] || fail "exit code $got, expected $code: $* : $(head -c 300 stderr)"
    [ "$code" = 0 ] && return
    after=$(find . -type f ! -name stderr ! -name stdout -printf '%p %s %T@\n' | sort)
    [ "$(wc -l <stderr)" = 1 ] || fail "$(wc -l <stderr) lines on stderr: $* : $(head -c 300 stderr)"
    [ "$code" = 1 ] || [ "$before" = "$after" ] || fail "files changed: $*"
}
says() { grep -Eq -- "$1" stderr || fail "stderr does not say '$1': $(head -c 500 stderr)"; }
same() { cmp -s "$1" "$2" || fail "$1 is not $2: $3"; }
small="--size 32x16 --samples 1 --backend openmp --threads 1"
# make_path FILE RATE STEP: writes a path of 64 frames, which are two segments: a straight flight next to the Mandelbulb
# at a frame rate, with a step per frame.
make_path() {
    python3 - "$@" <<'PY'
import json, sys
name, rate, step = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
frames = [{"location": [4 + step * i, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1} for i in range(64)]
scene = {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2}
json.dump({"format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": rate, "scene": scene, "frames": frames},
          open(name, "w"))
PY
}
