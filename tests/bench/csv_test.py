#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""csv_test.py BIN SOURCE: the CSV of a standard study has a line for each row of its JSON that
has a device. If a pivot table is made
from the CSV, by the column `application` or by the column `backend`, each cell has the kernel time of one row, and none
is the mean of several rows."""
import csv
import io
import json
import pathlib
import statistics
import subprocess
import sys

BIN, SOURCE = map(pathlib.Path, sys.argv[1:3])
STUDY = SOURCE / "results" / "bench.json"
STORED = json.loads(subprocess.check_output([BIN / "bench", "json", STUDY]))


def pivot(rows, *keys):
    """Returns the mean kernel seconds of each group of rows that agree in the columns `keys`."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(float(row["kernel_s"]))
    return {key: statistics.fmean(times) for key, times in groups.items()}


expected = {
    (row["fractal"], row["precision"], row["mode"], row["application"], str(row["device"])): row["figures"]["kernel_seconds"]["median"]
    for row in STORED["rows"] if row["figures"] is not None
}
problems = {key[:3] for key in expected}
made = subprocess.run([BIN / "bench", "csv", STUDY], capture_output=True, text=True, check=True).stdout
lines = list(csv.reader(io.StringIO(made)))
assert all(len(line) == len(lines[0]) for line in lines) and len(lines) == 1 + sum(row["fractal"] != "all" for row in STORED["rows"])
rows = [row for row in csv.DictReader(io.StringIO(made)) if row["fom"]]
for column in "application", "backend":
    found = pivot(rows, "fractal", "precision", "mode", column, "device")
    assert found.keys() == expected.keys(), f"by {column}: {found.keys() ^ expected.keys()}"
    for key, seconds in found.items():
        assert abs(seconds - expected[key]) < 1e-12, f"{key}: several rows are averaged"
assert len({row["problem"] for row in rows}) == len(problems), "the scalar text is a problem by itself"
assert sum(row["application"] == "openmp-scalar" for row in rows) == len(problems)
print("fine")
