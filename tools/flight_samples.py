#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""flight_samples.py FLYTHROUGH IMGDIFF FOLDER: measures gain and cost of anti-aliasing. Renders stills of the first
film of each fractal with 1 (softened), 2.25, 4 and 9 samples per pixel and compares them with 64. Writes
FOLDER/flight_samples.txt: root mean square difference in bytes (from imgdiff's PSNR), the fraction of visibly wrong
pixels, seconds of rendering per frame."""
import glob
import json
import os
import subprocess
import sys
import tempfile
import time

from table_file import put

EVERY = 720  # frames between stills, which gives ten per film
SIDES = (1, 1.5, 2, 3, 8)  # samples per pixel side; the last one gives the expected picture


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1) or (done.returncode == 1 and "imgdiff" not in command[0]):
        sys.exit(f"flight_samples: {' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def stills(flythrough, path, side, folder):
    """Renders every EVERYth frame. Returns seconds per frame."""
    start = time.monotonic()
    run(flythrough, "render", path, "--stills", folder, "--every", str(EVERY), "--samples", str(side), "--backend", "openmp")
    return (time.monotonic() - start) / len(glob.glob(folder + "/*.png"))


def compare(imgdiff, a, b):
    """Returns the mean square difference in bytes and the fraction of pixels off by more than 2 of 255."""
    result = json.loads(run(imgdiff, a, b, "--json"))
    psnr = result["psnr_db"] if isinstance(result["psnr_db"], (int, float)) else float("inf")
    return 255.0 ** 2 / 10 ** (psnr / 10), result["visibly_differing_pixels"] / (result["width"] * result["height"])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    flythrough, imgdiff, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
    lines = ["flight study: anti-aliasing", ""]
    lines.append(f"{'fractal':12}{'samples':>8}{'rms, bytes':>12}{'off by > 2/255':>16}{'s a frame':>11}")
    for fractal in ("mandelbulb", "mandelbox"):
        with tempfile.TemporaryDirectory() as scratch:
            path = os.path.join(scratch, "path.json")
            run(flythrough, "plan", path, "--fractal", fractal)
            seconds = {side: stills(flythrough, path, side, os.path.join(scratch, str(side))) for side in SIDES}
            names = sorted(os.path.basename(name) for name in glob.glob(f"{scratch}/{SIDES[-1]}/*.png"))
            for side in SIDES:
                pairs = [compare(imgdiff, f"{scratch}/{side}/{name}", f"{scratch}/{SIDES[-1]}/{name}") for name in names]
                rms = (sum(square for square, _ in pairs) / len(pairs)) ** 0.5
                off = sum(share for _, share in pairs) / len(pairs)
                figures = f"{rms:>12.2f}{100 * off:>14.1f} %" if side != SIDES[-1] else f"{'baseline':>12}{'':>16}"
                lines.append(f"{fractal:12}{side * side:>8g}{figures}{seconds[side]:>11.3f}")
    text = "\n".join(lines) + f"\n1920 x 1080, {len(names)} frames of each fractal's film, seed 1; seconds with reading the path and writing PNG\n"
    put(text, os.path.join(folder, "flight_samples.txt"))


if __name__ == "__main__":
    sys.exit(main())
