# SPDX-License-Identifier: Apache-2.0
"""Fake programs that replace bin/render, bin/imgdiff and bin/bench."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

# The folder of the tested programs.
TESTED = Path(shutil.which("bench") or Path(__file__).parents[2] / "bin" / "bench").parent

# A fake render, which writes a grey picture. With vulkan, one pixel of it differs. opencl is not available without a
# driver, and another backend may fail.
RENDER = f"""#!{sys.executable}
import json, os, sys
from PIL import Image
if "--list-fractals" in sys.argv:
    print(json.dumps({{"scene": {{}}, "fractals": []}}))
    sys.exit(0)
if "--list-devices" in sys.argv:
    for line in ("reference  0: CPU", "openmp     0: CPU", "opencl     " + os.environ.get("MADE_DRIVER", "unavailable: not here"), "vulkan     0: GPU"):
        print(line)
    sys.exit(0)
options = dict(zip(sys.argv[1::1], sys.argv[2::1]))
backend = options["--backend"]
if (backend == "opencl" and "MADE_DRIVER" not in os.environ) or (backend == "reference" and options["--precision"] == "float"):
    print(f"render: backend {{backend}}: not here", file=sys.stderr)
    sys.exit(77)
if backend == os.environ.get("MADE_FAILURE"):
    print(f"render: backend {{backend}}: device 0: it crashed", file=sys.stderr)
    sys.exit(1)
width, height = map(int, options["--size"].split("x"))
image = Image.new("RGB", (width, height), (100, 100, 100))
if backend == "vulkan":
    image.putpixel((5, 5), (110, 100, 100))
if options["--output"].endswith(".png"):
    image.save(options["--output"])
else:
    open(options["--output"], "w").write(backend == "vulkan" and "other" or "same")
json.dump({{"device": {{"name": backend + "'s device"}}}}, open(options["--stats"], "w"))
"""
# A fake imgdiff --json A B --map FILE, for the pictures above, which are the same or differ in one pixel.
IMGDIFF = """#!/bin/sh
cp "$2" "$5"
if cmp -s "$2" "$3"; then same=true pixels=0 largest=0 psnr=null; else same=false pixels=1 largest=10 psnr=75.5; fi
printf '{"width": 540, "height": 540, "same": %s, "differing_pixels": %s, "visibly_differing_pixels": %s, ' $same $pixels $pixels
printf '"largest_difference": %s, "psnr_db": %s}' $largest $psnr
$same
"""
# A fake bench csv FILE; bench json FILE, for a file that has its figures already, or is to be refused.
BENCH = """#!/bin/sh
[ "$1" = json ] && grep -q '"refused"' "$2" && { echo "bench: it is refused" >&2; exit 2; }
[ "$1" = json ] && exec cat "$2"
[ "$1" = csv ] && printf 'backend,kernel_s\\nopenmp,0.1\\n'
"""


def programs(folder: Path, names: Sequence[str] = ("render", "imgdiff", "bench")) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("render", RENDER), ("imgdiff", IMGDIFF), ("bench", BENCH)):
        if name not in names:
            continue
        (folder / name).write_text(text, encoding="utf-8")
        (folder / name).chmod(0o755)
    return folder
