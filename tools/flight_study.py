#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""flight_study.py PROGRAMS FOLDER [--seeds N] [--only seeds|samples|overhead]: measures films with PROGRAMS/flythrough.

seeds: plans a full film for each seed and fractal. Writes FOLDER/flight_seeds.txt, a table of all audit items with
their thresholds, and the audit and map of seed 1.
samples: measures the gain and cost of anti-aliasing. Renders stills of the first film of each fractal with 1 sample per
pixel (which flythrough softens), 2.25, 4 and 9, and compares them with stills of 64 samples. Writes
FOLDER/flight_samples.txt: root mean square difference in bytes (from imgdiff's PSNR), the fraction of visibly wrong
pixels, seconds of rendering per frame.
overhead: measures the overhead of a segment. Makes films of 10 and of 40 segments, so small that rendering takes almost
no time, in one process and, if mpirun exists, on 1, 2 and 4 ranks. The difference of the two times, divided by 30, is
the overhead of a segment without that of the program's start. Writes FOLDER/flight_overhead.txt.
Exit codes: 0 success, 1 a promise (a hard limit of the audit) is broken or a program fails."""
import argparse
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

from table_file import put, put_file

EVERY = 720  # frames from one still to the next; gives ten stills per film
SIDES = (1, 1.5, 2, 3, 8)  # square roots of the samples per pixel; the last gives the expected picture
FRAMES = 60  # per segment
FEW, MANY = 10, 40  # segments
ROUNDS = 3


def run(*command, codes=(0,)):
    """Runs a program. Returns the finished process and the seconds that it took. Exit codes other than `codes` are
    failures."""
    start = time.monotonic()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    if done.returncode not in codes:
        sys.exit(f"flight_study: {' '.join(command)}: {done.stderr.strip()}")
    return done, time.monotonic() - start


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def plan(program, fractal, seed, scratch, extra):
    """Plans a path. Returns its audit, a dict, and the seconds that planning and auditing took."""
    audit = os.path.join(scratch, "audit.json")
    done, seconds = run(program, "plan", os.path.join(scratch, "path.json"), "--fractal", fractal, "--seed", str(seed), "--json", audit,
                        *extra, codes=(0, 1))
    if not os.path.exists(audit):
        sys.exit(f"flight_study: {fractal}, seed {seed}: {done.stderr.strip()}")
    return json.loads(read(audit)), seconds


def number(value):
    return f"{value:.3g}"


def table(fractal, audits):
    """Returns a table with a line for each audit item. Its columns are the item's value for each seed, the threshold,
    and the number of seeds that keep it."""
    kept = sum(audit["promises_kept"] for audit, _ in audits)
    lines = [f"{fractal}: {audits[0][0]['frames']} frames, {len(audits)} seeds, {kept} of them with every promise kept; "
             "! is a promise, the others are quality"]
    lines.append(f"{'':46} {'bar':>9}" + "".join(f"{audit['seed']:>8}" for audit, _ in audits) + "    kept")
    for index, row in enumerate(audits[0][0]["rows"]):
        rows = [audit["rows"][index] for audit, _ in audits]
        bar = ("<= " if row["at_most"] else ">= ") + number(row["bar"])
        name = f"{'!' if row['promise'] else ' '} {row['name']}{', ' + row['unit'] if row['unit'] else ''}"
        lines.append(f"{name:46.46} {bar:>9}" + "".join(f"{number(r['value']):>8}" for r in rows) +
                     f"{sum(r['kept'] for r in rows):>5}/{len(rows)}")
    lines.append(f"{'  planning and audit, s':46} {'':>9}" + "".join(f"{seconds:>8.1f}" for _, seconds in audits))
    return "\n".join(lines) + "\n"


def study_seeds(program, folder, seeds):
    """Writes the table of all seeds. Returns true if every promise is kept."""
    text, kept = [f"flight study: {seeds} seeds of both fractals\n"], True
    for fractal, short in (("mandelbulb", "bulb"), ("mandelbox", "box")):
        audits = []
        for seed in range(1, seeds + 1):
            print(f"flight_study: {fractal}, seed {seed} of {seeds}", file=sys.stderr)
            with tempfile.TemporaryDirectory() as scratch:
                extra = ["--map", os.path.join(scratch, "map.json")] if seed == 1 else []
                audits.append(plan(program, fractal, seed, scratch, extra))
                if seed == 1:
                    put_file(read(os.path.join(scratch, "audit.json")), os.path.join(folder, f"flight_{short}.json"))
                    put_file(read(os.path.join(scratch, "map.json")), os.path.join(folder, f"map_{short}.json"))
        kept = kept and all(audit["promises_kept"] for audit, _ in audits)
        text.append(table(fractal, audits))
    put("\n".join(text), os.path.join(folder, "flight_seeds.txt"))
    return kept


def stills(flythrough, path, side, folder):
    """Renders a still every EVERY frames. Returns the seconds per still."""
    _, seconds = run(flythrough, "render", path, "--stills", folder, "--every", str(EVERY), "--samples", str(side), "--backend", "openmp")
    return seconds / len(glob.glob(folder + "/*.png"))


def compare(imgdiff, a, b):
    """Returns the mean square difference of two pictures' bytes, and the fraction of pixels that are off."""
    result = json.loads(run(imgdiff, a, b, "--json", codes=(0, 1))[0].stdout)
    psnr = result["psnr_db"] if isinstance(result["psnr_db"], (int, float)) else float("inf")
    return 255.0 ** 2 / 10 ** (psnr / 10), result["visibly_differing_pixels"] / (result["width"] * result["height"])


def study_samples(flythrough, imgdiff, folder):
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


def launchers():
    """Returns the ways to start flythrough, as (name, words that precede the command): in one process and, if mpirun
    exists, on 1, 2 and 4 ranks."""
    found = [("one process", [])]
    if shutil.which("mpirun"):
        found += [(f"mpirun -n {n}", ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(n)]) for n in (1, 2, 4)]
    return found


def study_overhead(program, folder):
    head = f"{'':14}" + "".join(f"{f'{n} segments, s':>16}" for n in (FEW, MANY)) + f"{'ms a segment':>16}"
    lines = ["flight study: what a segment costs beside its drawing", "", head]
    with tempfile.TemporaryDirectory() as scratch:
        paths = {}
        for segments in (FEW, MANY):
            paths[segments] = os.path.join(scratch, f"{segments}.json")
            run(program, "plan", paths[segments], "--frames", str(segments * FRAMES))
        for name, launcher in launchers():
            seconds = {}
            for segments, path in paths.items():
                film = os.path.join(scratch, "film.mp4")
                times = []
                for _ in range(ROUNDS):
                    times.append(run(*launcher, program, "render", path, "--size", "64x36", "--samples", "1", "--backend",
                                     "openmp", "--output", film)[1])
                    os.remove(film)
                    os.remove(film + ".made")
                seconds[segments] = sorted(times)[ROUNDS // 2]
            cost = 1000 * (seconds[MANY] - seconds[FEW]) / (MANY - FEW)
            lines.append(f"{name:14}" + "".join(f"{seconds[n]:>16.2f}" for n in (FEW, MANY)) + f"{cost:>16.0f}")
    lines.append(f"Films of 64 x 36 on {os.cpu_count()} cores, the median of {ROUNDS} runs. A segment is {FRAMES} frames: asking")
    lines.append("for it, starting the encoder, drawing and encoding tiny frames, syncing and renaming the file.")
    text = "\n".join(lines) + "\n"
    put(text, os.path.join(folder, "flight_overhead.txt"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--only", choices=("seeds", "samples", "overhead"))
    arguments = parser.parse_args()
    flythrough, imgdiff = (os.path.join(os.path.abspath(arguments.programs), name) for name in ("flythrough", "imgdiff"))
    if arguments.only in (None, "seeds") and not study_seeds(flythrough, arguments.folder, arguments.seeds):
        return 1
    if arguments.only in (None, "samples"):
        study_samples(flythrough, imgdiff, arguments.folder)
    if arguments.only in (None, "overhead"):
        study_overhead(flythrough, arguments.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
