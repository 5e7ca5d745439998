#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""progress_test.py BIN: if stderr is a terminal, bench shows the rounds and the time left in one line, which changes.
Otherwise it prints each message once. Exit code 77: the system has no pseudoterminals, and CI is not set."""
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile

BENCH = pathlib.Path(sys.argv[1], "bench")
ROWS = ["--backend", "openmp", "--fractal", "box", "--size", "64x64", "--precision", "float"]


def on_terminal(folder, *words):
    """Runs bench with a terminal as stderr, and returns the output on the terminal."""
    try:
        master, terminal = pty.openpty()
    except OSError as error:
        print(error)
        sys.exit(1 if "CI" in os.environ else 77)
    with open(folder / "out", "w", encoding="utf-8") as out:
        bench = subprocess.Popen([BENCH, *words], stdout=out, stderr=terminal)
    os.close(terminal)
    text = b""
    while True:
        try:
            block = os.read(master, 1 << 16)
        except OSError:  # the other end is closed
            break
        if not block:
            break
        text += block
    os.close(master)
    assert bench.wait() == 0, text
    return text.decode()


noted = subprocess.run([BENCH, *ROWS, "--no-peaks", "--repetitions", "2"], capture_output=True, text=True, check=True).stderr
assert "bench: timing\n" in noted and "round" not in noted and "\r" not in noted, noted
noted = subprocess.run([BENCH, "peak", "--precision", "float"], capture_output=True, text=True, check=True).stderr
assert [line for line in noted.splitlines() if "peak" in line] == ["bench: multiply-add peaks"], noted

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    said = on_terminal(folder, *ROWS, "--no-peaks", "--repetitions", "12", "--runs", "2")
    rounds = [int(round) for round in re.findall(r"timing \[[#.]+\] +\d+ %, round (\d+) of 12, \d+ s left", said)]
    assert len(rounds) > 2 and rounds == sorted(rounds) and rounds[-1] > rounds[0], said[-3000:]
    assert re.search(r"further runs \[[#.]+\] +50 %, run 2 of 2, \d+ s left", said), said[-3000:]
    assert "\n" not in said, "lines beside the one that changes"
    said = on_terminal(folder, "peak", "--precision", "float")
    assert re.search(r"multiply-add peaks \[[#.]+\] +\d+ %, \w+ float", said), said[-3000:]
print("fine")
