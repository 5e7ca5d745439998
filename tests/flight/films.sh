# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts with cases of flythrough, which tests/cases.sh runs with BIN SOURCE.
bin=$1
source=$2
program=$bin/flythrough
small="--size 32x16 --samples 1 --backend openmp --threads 1"
# run CODE ARGUMENT...: runs flythrough and checks its exit code, messages and files.
run() { expect "$1" "$program" "${@:2}"; }
# make_path FILE RATE STEP [FRAMES]: writes a path of 64 frames, which are two segments. It is a straight flight next to
# the Mandelbulb, with RATE frames per second and a step of length STEP per frame.
make_path() {
    python3 - "$@" <<'PY'
import json, sys
name, rate, step = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
count = int(sys.argv[4]) if len(sys.argv) > 4 else 64
frames = [{"location": [4 + step * i, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1} for i in range(count)]
scene = {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2}
json.dump({"format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": rate, "scene": scene, "frames": frames},
          open(name, "w"))
PY
}
make_path path.json 30 0.02
# whole: renders the film with which others are compared.
whole() { run 0 render path.json $small --output whole.mp4; }

# other_instructions: prints the name of another instruction set than the one that is used by default.
other_instructions() {
    MANDELMARCH_INSTRUCTIONS=none "$bin/render" --fractal bulb --backend openmp --size 8x8 --output none.png 2>&1 |
        sed -n 's/.*, \(.*\) on this machine$/\1/p'
}
