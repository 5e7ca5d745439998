#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""flight_study.py PROGRAMS FOLDER [--seeds N]: plans a full film for each seed and fractal with
PROGRAMS/flythrough. Writes FOLDER/flight_seeds.txt, a table of all audit items with their thresholds, and the audit and
map of seed 1.
Exit codes: 0 success, 1 a promise (a hard limit of the audit) is broken, 2 a program fails."""
import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
from mandelreport.errors import output_of, read_json, run_program, write_whole


def plan(program, fractal, seed, scratch, extra):
    """Plans a path. Returns its audit, a dict, and the seconds that planning and auditing took."""
    audit = os.path.join(scratch, "audit.json")
    start = time.monotonic()
    output_of(program, "plan", os.path.join(scratch, "path.json"), "--fractal", fractal, "--seed", seed, "--json", audit, *extra, codes=(0, 1))
    seconds = time.monotonic() - start
    return read_json(Path(audit), "an audit"), seconds


def table(fractal, audits):
    """Returns a table with a line for each audit item. Its columns are the item's value for each seed, the threshold,
    and the number of seeds that keep it."""
    kept = sum(audit["promises_kept"] for audit, _ in audits)
    lines = [f"{fractal}: {audits[0][0]['frames']} frames, {len(audits)} seeds, {kept} of them with every promise kept; "
             "! is a promise, the others are quality"]
    lines.append(f"{'':46} {'bar':>9}" + "".join(f"{audit['seed']:>8}" for audit, _ in audits) + "    kept")
    for index, row in enumerate(audits[0][0]["rows"]):
        rows = [audit["rows"][index] for audit, _ in audits]
        bar = ("<= " if row["at_most"] else ">= ") + f"{row['bar']:.3g}"
        name = f"{'!' if row['promise'] else ' '} {row['name']}{', ' + row['unit'] if row['unit'] else ''}"
        lines.append(f"{name:46.46} {bar:>9}" + "".join(f"{r['value']:>8.3g}" for r in rows) +
                     f"{sum(r['kept'] for r in rows):>5}/{len(rows)}")
    most = {"mandelbulb": 10, "mandelbox": 15}[fractal]
    planning = [audit["planning_seconds"] for audit, _ in audits]
    lines.append(f"{'  planning, s':46} {f'<= {most}':>9}" + "".join(f"{value:>8.3g}" for value in planning) +
                 f"{sum(value <= most for value in planning):>5}/{len(planning)}")
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
                map_file = os.path.join(scratch, "map.json")
                audits.append(plan(program, fractal, seed, scratch, ["--map", map_file] if seed == 1 else []))
                if seed == 1:
                    write_whole(Path(folder, f"flight_{short}.json"), Path(scratch, "audit.json").read_bytes())
                    write_whole(Path(folder, f"map_{short}.json"), Path(map_file).read_bytes())
        kept = kept and all(audit["promises_kept"] for audit, _ in audits)
        text.append(table(fractal, audits))
    write_whole(Path(folder, "flight_seeds.txt"), "\n".join(text).encode())
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=10)
    arguments = parser.parse_args()
    flythrough = os.path.join(os.path.abspath(arguments.programs), "flythrough")
    return 0 if study_seeds(flythrough, arguments.folder, arguments.seeds) else 1


if __name__ == "__main__":
    run_program("flight_study", main)
