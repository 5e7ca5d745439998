#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""duel_study.py BENCH_SLOWED [--duels N] [--slower PERCENT] [--load N] [--table FILE]: how often bench duel is right, on this
machine: N duels of a program with itself, and as many with one that takes PERCENT longer (tests/bench/slowed_bench.cpp), while
--load processes keep cores busy. A duel has ten launches of two rows. Exit codes: 0 measured, 1 a duel failed."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from table_file import put

ROWS = ["--backend", "openmp", "--precision", "float", "--mode", "exact", "--size", "160x120", "--launches", "10", "--repetitions", "20"]


def duel(folder, old, new):
    """{row: (verdict, ratio)} of a duel, and the environment of the second program."""
    target = os.path.join(folder, "duel.json")
    run = subprocess.run([f"./{old}", "duel", f"./{old}", f"./{new}", *ROWS, "--json", target], cwd=folder,
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(f"duel_study: {(run.stderr.strip().splitlines() or ['bench duel failed'])[-1]}")
    with open(target, encoding="utf-8") as file:
        data = json.load(file)
    return {row["name"]: (row["verdict"], row["ratio"]) for row in data["verdicts"]}, data["new"]["environment"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--duels", type=int, default=20)
    parser.add_argument("--slower", type=int, default=3)
    parser.add_argument("--load", type=int, default=0)
    parser.add_argument("--table")
    arguments = parser.parse_args()
    slower = f"slowed_{arguments.slower}"
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(arguments.load)]
    try:
        with tempfile.TemporaryDirectory() as folder:
            for name in ("slowed_0", slower):
                os.symlink(os.path.abspath(arguments.program), os.path.join(folder, name))
            found = {new: [duel(folder, "slowed_0", new) for _ in range(arguments.duels)] for new in ("slowed_0", slower)}
    finally:
        for process in busy:
            process.kill()
    cpu = found["slowed_0"][0][1]["cpu"]
    lines = [f"duel study: {arguments.duels} duels each, ten launches, {arguments.load} busy processes, "
             f"{cpu.get('platform', cpu['model'])}, {cpu['cores_usable']} threads",
             f"{'programs':<28}{'row':<34}{'SLOWER':>8}{'faster':>8}{'same':>8}{'undecided':>11}{'least':>8}{'most':>8}"]
    for new, duels in found.items():
        for row in duels[0][0]:
            verdicts = [judged[row][0] for judged, _ in duels]
            ratios = [judged[row][1] for judged, _ in duels]
            counts = [verdicts.count(v) for v in ("SLOWER", "faster", "same", "undecided")]
            what = "equal" if new == "slowed_0" else f"{arguments.slower} % slower"
            lines.append(f"{what:<28}{row:<34}{counts[0]:>8}{counts[1]:>8}{counts[2]:>8}{counts[3]:>11}{min(ratios):>8.3f}{max(ratios):>8.3f}")
        alarms = sum(any(verdict in ("SLOWER", "faster") for verdict, _ in judged.values()) for judged, _ in duels)
        lines.append(f"{'':<28}duels that call any row faster or slower: {alarms} of {arguments.duels}")
    put("\n".join(lines) + "\n", arguments.table)


if __name__ == "__main__":
    main()
