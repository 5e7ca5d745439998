#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""progress_test.py BIN: if stderr is a terminal, bench shows the rounds and the time left in one line, which changes.
Otherwise it prints each message once. Ctrl+C loses no samples. Exit code 77: the system has no pseudoterminals, and CI is not set."""
import json
import os
import pathlib
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time

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
    # Ctrl+C: what was measured is written and marked, and can be continued. The second time, a further run is measured.
    result = folder / "result.json"
    for phase in "timing", "further runs":
        rounds = "100000" if phase == "timing" else "2"
        command = [BENCH, *ROWS, "--no-peaks", "--repetitions", rounds, "--runs", "1000", "--json", result]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as bench:
            while phase not in bench.stderr.readline():
                assert bench.poll() is None, "no such phase"
            time.sleep(1)
            bench.send_signal(signal.SIGINT)
            assert bench.wait() == -signal.SIGINT, bench.returncode
        written = json.loads(result.read_text(encoding="utf-8"))
        assert any("interrupted" in warning for warning in written["warnings"]), written["warnings"]
        assert all(row["samples"] for row in written["rows"] if row.get("device_name")), written["rows"]
    runs = str(written["runs"] + 1)
    command = [BENCH, *ROWS, "--no-peaks", "--repetitions", "2", "--runs", runs, "--continue", result, "--json", result]
    subprocess.run(command, capture_output=True, check=True)
    assert str(json.loads(result.read_text(encoding="utf-8"))["runs"]) == runs
    # A backend that the result lacks is refused.
    refused = subprocess.run([word if word != "openmp" else "reference" for word in command], capture_output=True, text=True)
    assert refused.returncode == 2 and "no row of reference" in refused.stderr, refused
print("fine")
