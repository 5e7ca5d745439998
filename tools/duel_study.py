#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""duel_study.py BENCH_SLOWED [--duels N] [--slower PERCENT] [--load N] [--table FILE]: measures how often bench duel is
right on this machine. Runs N duels of a program with itself, and N with one that takes PERCENT longer
(tests/bench/slowed_bench.cpp): on an idle machine by the wall clock, and with --load busy processes by the wall clock
and by processor time. A duel has ten runs of two configurations. Exit codes: 0 measured, 1 a duel failed."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

from table_file import put

ROWS = ["--backend", "openmp", "--precision", "float", "--mode", "exact", "--size", "320x180", "--runs", "10", "--repetitions", "20"]
COLUMNS = {"SLOWER": 8, "faster": 8, "same": 8, "undecided": 11}  # verdicts and the widths of their columns


def duel(folder, old, new, clock):
    """Runs a duel of the programs `old` and `new`. Returns {row: (verdict, ratio)} and the environment of `new`."""
    target = os.path.join(folder, "duel.json")
    run = subprocess.run([f"./{old}", "duel", f"./{old}", f"./{new}", *ROWS, "--clock", clock, "--json", target], cwd=folder,
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(f"duel_study: {(run.stderr.strip().splitlines() or ['bench duel failed'])[-1]}")
    data = json.loads(subprocess.check_output([f"./{old}", "json", target], cwd=folder))
    return {row["name"]: (row["verdict"], row["ratio"]) for row in data["verdicts"]}, data["new"]["environment"]


def duels(folder, slower, arguments, load, clock):
    """Runs --duels duels of slowed_0 with itself, and as many with the program `slower`, while `load` processes keep
    cores busy. Returns their results by program: {program: [result of duel()]}."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(load)]
    try:
        return {new: [duel(folder, "slowed_0", new, clock) for _ in range(arguments.duels)] for new in ("slowed_0", slower)}
    finally:
        for process in busy:
            process.kill()
            process.wait()


def lines_of(found, slower):
    """Yields the table's lines for `found`, the result of duels(). `slower`: the label of the slower program."""
    for new, judged in found.items():
        what = "equal" if new == "slowed_0" else slower
        for row in judged[0][0]:
            verdicts = [rows[row][0] for rows, _ in judged]
            ratios = [rows[row][1] for rows, _ in judged]
            counts = "".join(f"{verdicts.count(v):>{width}}" for v, width in COLUMNS.items())
            yield f"{what:<12}{row:<34}{counts}{min(ratios):>8.3f}{max(ratios):>8.3f}"
        called = sum(any(verdict in ("SLOWER", "faster") for verdict, _ in rows.values()) for rows, _ in judged)
        yield f"{'':<12}duels that call any row faster or slower: {called} of {len(judged)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--duels", type=int, default=20)
    parser.add_argument("--slower", type=int, default=3)
    parser.add_argument("--load", type=int, default=2)
    parser.add_argument("--table")
    arguments = parser.parse_args()
    slower = f"slowed_{arguments.slower}"
    lines = [f"{'programs':<12}{'row':<34}" + "".join(f"{v:>{w}}" for v, w in COLUMNS.items()) + f"{'min':>8}{'max':>8}"]
    with tempfile.TemporaryDirectory() as folder:
        for name in ("slowed_0", slower):
            os.symlink(os.path.abspath(arguments.program), os.path.join(folder, name))
        for load, clock in ((0, "wall"), (arguments.load, "wall"), (arguments.load, "processor")):
            found = duels(folder, slower, arguments, load, clock)
            lines += [f"{load} busy processes, --clock {clock}", *lines_of(found, f"{arguments.slower} % slower")]
            cpu = found["slowed_0"][0][1]["cpu"]
    lines.insert(0, f"duel study: {arguments.duels} duels each, ten runs, {cpu.get('platform', cpu['model'])}, "
                    f"{cpu['cores_usable']} threads")
    put("\n".join(lines) + "\n", arguments.table)


if __name__ == "__main__":
    main()
