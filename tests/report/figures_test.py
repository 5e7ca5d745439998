# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/results.md and README.md are those of the result files. Some are computed again here from the
samples, with scipy and without the project's statistics: an interval, the cost of a model, the ladder, and three figures
by lot, which changes daily."""

from __future__ import annotations

import copy
import datetime
import math
import random
import re
import sys
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
from scipy import stats

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "report"))

from mandelreport import results_page  # noqa: E402
from mandelreport.results import RESULTS, read_results  # noqa: E402

READ = read_results(ROOT / RESULTS)
PAGE = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
FRACTALS = ("mandelbulb", "mandelbox")
Rows = dict[str, dict[str, Any]]  # by name
Check = tuple[str, str, str, Callable[[Rows], list[float]]]  # file, name of a row, the page's text, its numbers


def with_ends(value: float, runs: list[float]) -> list[float]:
    """Returns a value and Student's 95 % interval of the runs' logarithms, widened to contain the value."""
    logs = numpy.log(runs)
    low, high = numpy.exp(stats.t.interval(0.95, len(logs) - 1, logs.mean(), stats.sem(logs)))
    return [value, min(low, value), max(high, value)]


def by_run(row: dict[str, Any], clock: str) -> list[list[float]]:
    return [[s[clock] for s in row["samples"] if s["run"] == run] for run in sorted({s["run"] for s in row["samples"]})]


def time(row: dict[str, Any]) -> list[float]:
    runs = by_run(row, "kernel")
    return [1e3 * end for end in with_ends(numpy.median(sum(runs, [])), [numpy.median(run) for run in runs])]


def speed_up(row: dict[str, Any], base: dict[str, Any]) -> list[float]:
    own, other = by_run(row, "wall"), by_run(base, "wall")
    value = numpy.median(sum(other, [])) / numpy.median(sum(own, []))
    return with_ends(value, [numpy.median(b) / numpy.median(a) for a, b in zip(own, other)])


def gain(before: dict[str, Any], after: dict[str, Any]) -> list[float]:
    """Returns the inverse of the median ratio of times in the same rounds, and its interval."""
    base = {(s["run"], s["round"]): s["kernel"] for s in before["samples"]}
    ratios = {at: s["kernel"] / base[at] for s in after["samples"] if (at := (s["run"], s["round"])) in base}
    runs = [[ratio for at, ratio in ratios.items() if at[0] == run] for run in sorted({run for run, _ in ratios})]
    value, low, high = with_ends(numpy.median(list(ratios.values())), [numpy.median(run) for run in runs])
    return [1 / value, 1 / high, 1 / low]


def base_of(name: str, column: str) -> str:
    fractal, precision, mode = name.split("/")[:3]
    return f"{fractal}/double/exact/reference/0" if column == "over serial" else f"{fractal}/{precision}/{mode}/openmp/0/simd-width=1"


def timings() -> list[Check]:
    """Returns a check for each time and speed-up in the page's tables of all times of a file."""
    checks: list[Check] = []
    for file, lines in re.findall(r"^All times of (\S+): [^|]*\n\n((?:\|.*\n)+)", PAGE, re.M):
        head, _, *rows = ([cell.strip() for cell in line.split("|")[1:-1]] for line in lines.splitlines())
        for row in (dict(zip(head, cells)) for cells in rows):
            backend, scalar, _ = row["backend"].removesuffix(" (1 thread)").partition("-scalar")
            name = f"{row['fractal']}/{row['precision']}/{row['mode']}/{backend}/0{'/simd-width=1' if scalar else ''}"
            checks.append((file, name, row["kernel ms"], lambda rows, name=name: time(rows[name])))
            for column in ("over serial", "over scalar"):
                if "[" in row[column]:
                    compute = lambda rows, name=name, base=base_of(name, column): speed_up(rows[name], rows[base])  # noqa: E731
                    checks.append((file, name, row[column], compute))
    return checks


def cost_of_stdpar(rows: Rows) -> list[float]:
    speeds = [speed_up(row, rows[base_of(name, "")]) for name, row in rows.items() if row["backend"] == "stdpar"]
    return [*min(speeds), *max(speeds)]


def rungs(rows: Rows, fractal: str) -> list[dict[str, Any]]:
    return [row for row in rows.values() if row["fractal"] == fractal]


def faults(checks: list[Check], files: dict[str, Rows]) -> list[str]:
    found = []
    for file, name, text, compute in checks:
        said, values = [float(number.replace(",", "")) for number in re.findall(r"\d[\d,.]*\d|\d", text)], compute(files[file])
        if said != [float(f"{value:.3g}") for value in values]:
            found.append(f"{file}, {name}: the page says {text}, the samples {values}")
    return found


class FiguresTest(unittest.TestCase):
    def setUp(self) -> None:
        self.files = {bench.name: {row["name"]: row for row in bench.data["rows"]} for bench in READ.benches}

    def test_the_pages_are_those_of_the_results(self) -> None:
        for path, text in results_page.pages(READ).items():
            self.assertEqual(path.read_text(encoding="utf-8"), text, f"{path}: make results-page")

    def test_figures_are_those_of_the_samples(self) -> None:
        cost = re.search(r"`stdpar` (\S+ \[.*?\] to \S+ \[.*?\])", PAGE.replace("\n", " "))
        whole = re.findall(r"^\| all together \|  \| (.*?) \|  \| (.*?) \|$", PAGE, re.M)
        assert cost and len(whole) == 1
        day = datetime.date.today().isoformat()
        print(f"lot of {day}")
        every = timings()
        checks = [every[0], *random.Random(day).sample(every, 3), ("bench.json", "mandelbulb/double/fast/stdpar/0", cost[1], cost_of_stdpar)]
        for fractal, text in zip(FRACTALS, whole[0]):
            ladder = rungs(self.files["ladder.json"], fractal)
            compute = lambda rows, fractal=fractal: gain(*rungs(rows, fractal)[:: len(ladder) - 1])  # noqa: E731
            checks.append(("ladder.json", ladder[-1]["name"], text, compute))
        self.assertEqual(faults(checks, self.files), [])
        for check in checks:  # the negative control: other samples in one run
            changed = copy.deepcopy(self.files[check[0]])
            for sample in (sample for sample in changed[check[1]]["samples"] if sample["run"] == 0):
                sample |= {"kernel": 1.5 * sample["kernel"], "wall": 1.5 * sample["wall"]}
            self.assertEqual(len(faults([check], {check[0]: changed})), 1, check[:3])

    def test_gains_of_rungs_multiply_to_the_whole_ladder(self) -> None:
        table = re.search(r"^\| rung .*?\n((?:\|.*\n)+)", PAGE, re.M)
        assert table
        for column, fractal in zip((3, 6), FRACTALS):
            cells = [line.split("|")[column].strip() for line in table[1].splitlines()[2:-1]]
            _, low, high = gain(*rungs(self.files["ladder.json"], fractal)[:: len(cells)])
            product = math.prod(map(float, cells))
            self.assertTrue(low < product < high, fractal)
            self.assertFalse(low < product * float(cells[0]) < high, "a rung that is counted twice is found")


if __name__ == "__main__":
    unittest.main(verbosity=2)
