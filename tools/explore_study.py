#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""explore_study.py EXPLORE FLYTHROUGH FOLDER: measures frame times of the explorer for scripted flights through the
official scenes and along the tours of seeds 1 and 2 of both studied fractals, at 960 x 540 and 1920 x 1080, in fast
float on openmp.

Writes FOLDER/explore.json, with every flight's percentiles, and FOLDER/explore.txt, a table. The window opens on
DISPLAY, or nowhere with SDL_VIDEODRIVER=dummy; the table says which. Run it on an idle machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SIZES = ["960x540", "1920x1080"]
FRACTALS = ["mandelbulb", "mandelbox"]
SEEDS = [1, 2]
FRAMES = 1800  # per tour, at 30 a second
PLAYED = 900  # frames of the window
# Towards the fractal, along it and around it, by key presses.
BY_HAND = ["key W 120", "press A", "key Left 90", "release A", "press D", "key Right 90", "release D", "key R 60", "key W 60"]


def script(paths: dict[tuple[str, int], Path]) -> str:
    lines = ["key F2", "rest"]
    for fractal in FRACTALS:
        lines += [f"scene {fractal}", "rest", f"measure {fractal}:official", *BY_HAND, "end"]
        for seed in SEEDS:
            lines += [f"open {paths[fractal, seed]}", "rest", "key F12", f"measure {fractal}:seed-{seed}", f"play {PLAYED}", "end"]
    return "\n".join(lines) + "\n"


def row(size: str, section: dict) -> str:
    frame, latency, share = section["frame_ms"], section["latency_frames"], section["share_of_pixels"]
    fractal, flight = section["name"].split(":")
    return (
        f"{fractal:<11}{flight:<10}{size:<10}{section['frames']:>6}{frame['p50']:>8.1f}{frame['p95']:>8.1f}{frame['p99']:>8.1f}"
        f"{100 * section['within_16_7_ms']:>10.1f}{section['pictures_per_second']:>12.1f}{latency['p50']:>9.0f}{latency['p99']:>5.0f}"
        f"{latency['p100']:>5.0f}{100 * share['p50']:>10.0f}"
    )


def main() -> int:
    if len(sys.argv) != 4:
        print(__doc__, file=sys.stderr)
        return 2
    explore, flythrough, folder = (Path(word) for word in sys.argv[1:])
    if (code := subprocess.run([explore, "--script", os.devnull], check=False).returncode) != 0:
        return code
    runs, rows = [], []
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        paths = {}
        for fractal in FRACTALS:
            for seed in SEEDS:
                path = paths[fractal, seed] = Path(scratch) / f"{fractal}-{seed}.json"
                # A broken promise gives another exit code, but the path is complete.
                subprocess.run([flythrough, "plan", path, "--fractal", fractal, "--seed", str(seed), "--frames", str(FRAMES)], stdout=subprocess.DEVNULL, check=False)
        played = Path(scratch) / "script.txt"
        played.write_text(script(paths), encoding="utf-8")
        for size in SIZES:
            stats = Path(scratch) / "stats.json"
            command = [explore, "--script", played, "--stats", stats, "--size", size, "--backend", "openmp", "--precision", "float", "--mode", "fast"]
            subprocess.run(command, check=True, env={**os.environ, "XDG_CONFIG_HOME": scratch})
            runs.append(json.loads(stats.read_text(encoding="utf-8")))
            rows += [row(size, section) for section in runs[-1]["sections"]]
    one = runs[0]
    table = (
        f"{one['cpu']}, {one['threads']} threads, {one['drawn_by']}, {one['instruction_set']}; shown by {one['shown_by']}, {one['screen_rate']:.0f} Hz\n"
        "Frame: from its events to its presentation. Latency: frames of the window from an event to its picture. Pixels: of the window, drawn\n"
        "while moving, the median; the rest is scaled.\n"
        f"{'fractal':<11}{'flight':<10}{'size':<10}{'frames':>6}{'p50 ms':>8}{'p95 ms':>8}{'p99 ms':>8}{'% in 16.7':>10}"
        f"{'pictures/s':>12}{'latency':>9}{'p99':>5}{'most':>5}{'% pixels':>10}\n" + "\n".join(rows) + "\n"
    )
    (folder / "explore.json").write_text(json.dumps({"schema": "mandelmarch-explore", "version": 1, "runs": runs}, indent=2) + "\n", encoding="utf-8")
    (folder / "explore.txt").write_text(table, encoding="utf-8")
    print(table, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
