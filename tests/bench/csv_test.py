#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""csv_test.py BIN SOURCE: the CSV of a standard study gives the same winners as its JSON, grouped by the column
`application` or by the column `backend`."""
import csv
import io
import json
import pathlib
import subprocess
import sys

BIN, SOURCE = map(pathlib.Path, sys.argv[1:3])
STUDY = SOURCE / "report" / "results" / "bench.json"


def lines_of(text):
    return [row for row in csv.DictReader(io.StringIO(text)) if row["fom"]]


def means(rows, *keys):
    """Returns the mean kernel seconds of each group of rows with the same keys, like a pivot table."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(float(row["kernel_s"]))
    return {key: sum(times) / len(times) for key, times in groups.items()}


def winners(times):
    """Returns the fastest application for each problem."""
    best = {}
    for (*problem, application), seconds in times.items():
        if tuple(problem) not in best or seconds < best[tuple(problem)][1]:
            best[tuple(problem)] = (application, seconds)
    return best


def expected():
    """Returns the fastest application for each problem, from the JSON."""
    best = {}
    for row in json.loads(STUDY.read_text())["rows"]:
        if row["figures"] is None:
            continue
        problem = (row["fractal"], row["precision"], row["mode"])
        seconds = row["figures"]["kernel_seconds"]["median"]
        if problem not in best or seconds < best[problem][1]:
            best[problem] = (row["application"], seconds)
    return best


def names(best):
    return {problem: winner for problem, (winner, _) in best.items()}


made = subprocess.run([BIN / "bench", "csv", STUDY], capture_output=True, text=True, check=True).stdout
for origin, text in ("bench csv", made), ("report/results/bench.csv", STUDY.with_suffix(".csv").read_text()):
    rows = lines_of(text)
    for column in "application", "backend":
        found = winners(means(rows, "fractal", "precision", "mode", column))
        assert names(found) == names(expected()), f"{origin}: a pivot by {column} finds {found}, expected {expected()}"
        for problem, (_, seconds) in found.items():
            assert abs(seconds - expected()[problem][1]) < 1e-12, f"{origin}: {problem}: several rows are averaged"
    by_problem = winners(means(rows, "problem", "application"))
    assert len(by_problem) == len(expected()), f"{origin}: the scalar text is a problem by itself"
    assert sum(row["application"] == "openmp-scalar" for row in rows) == len(expected()), origin
    assert "precision" in rows[0] and "number" not in rows[0]
print("fine")
