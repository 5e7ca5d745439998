#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""flight_seeds.py FLYTHROUGH FOLDER [SEEDS]: plans a full film for each seed and fractal. Writes
FOLDER/flight_seeds.txt, a table of all audit items with their thresholds, and the audit and map of seed 1. Exit code 1
if a promise is broken."""
import json
import os
import subprocess
import sys
import tempfile
import time

from table_file import put


def plan(program, fractal, seed, scratch, extra):
    """Returns the audit of one planned path, a dict, and the seconds that planning and auditing took."""
    audit = os.path.join(scratch, "audit.json")
    start = time.monotonic()
    done = subprocess.run([program, "plan", os.path.join(scratch, "path.json"), "--fractal", fractal, "--seed", str(seed),
                           "--json", audit, *extra], capture_output=True, text=True)
    seconds = time.monotonic() - start
    if done.returncode not in (0, 1) or not os.path.exists(audit):
        sys.exit(f"flight_seeds: {fractal}, seed {seed}: {done.stderr.strip()}")
    with open(audit, encoding="utf-8") as file:
        return json.load(file), seconds


def number(value):
    return f"{value:.3g}"


def table(fractal, audits):
    """Returns a table with one line per audit item, one column per seed, the threshold, and how many seeds meet it."""
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


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    seeds = int(sys.argv[3]) if len(sys.argv) == 4 else 10
    text, broken = [f"flight study: {seeds} seeds of both fractals\n"], False
    for fractal, short in (("mandelbulb", "bulb"), ("mandelbox", "box")):
        audits = []
        for seed in range(1, seeds + 1):
            print(f"flight_seeds: {fractal}, seed {seed} of {seeds}", file=sys.stderr)
            with tempfile.TemporaryDirectory() as scratch:
                extra = ["--map", os.path.join(scratch, "map.json")] if seed == 1 else []
                audits.append(plan(program, fractal, seed, scratch, extra))
                for name in ("audit", "map") if seed == 1 else ():
                    target = os.path.join(folder, f"{'flight' if name == 'audit' else 'map'}_{short}.json")
                    with open(os.path.join(scratch, name + ".json"), encoding="utf-8") as source, \
                            open(target + ".part", "w", encoding="utf-8") as copy:
                        copy.write(source.read())
                    os.replace(target + ".part", target)
        broken |= not all(audit["promises_kept"] for audit, _ in audits)
        text.append(table(fractal, audits))
    put("\n".join(text), os.path.join(folder, "flight_seeds.txt"))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
