# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/results.md and README.md are those of the result files. Some are computed again from the samples,
with scipy and without the project's statistics: an interval, the cost of a model, the ladder, and three figures by lot,
which changes daily."""

import copy
import datetime
import functools
import math
import random
import re
import sys
import unittest
from pathlib import Path

import numpy
from scipy import stats

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "report"))

import made_programs  # noqa: E402
from mandelreport import results_page  # noqa: E402
from mandelreport.results import RESULTS, read_results  # noqa: E402

READ = read_results(ROOT / RESULTS, made_programs.TESTED)
FILES = {bench.name: {row["name"]: row for row in bench.data["rows"]} for bench in READ.benches}
PAGE = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")


def with_ends(value, runs):
    """Returns the value and Student's 95 % interval of the runs' logarithms, widened to contain the value. `runs`: the
    samples by run."""
    logs = numpy.log([numpy.median(run) for run in runs])
    low, high = numpy.exp(stats.t.interval(0.95, len(logs) - 1, logs.mean(), stats.sem(logs)))
    return [value, min(low, value), max(high, value)]


def by_run(row, clock):
    runs = {sample["run"]: [] for sample in row["samples"]}
    for sample in row["samples"]:
        runs[sample["run"]].append(sample[clock])
    return list(runs.values())


def milliseconds(name, rows):
    runs = by_run(rows[name], "kernel")
    return [1e3 * end for end in with_ends(numpy.median(sum(runs, [])), runs)]


def speed_up(name, base, rows):
    own, other = by_run(rows[name], "wall"), by_run(rows[base], "wall")
    value = numpy.median(sum(other, [])) / numpy.median(sum(own, []))
    return with_ends(value, [[numpy.median(b) / numpy.median(a)] for a, b in zip(own, other)])


def gain(fractal, rows):
    """Returns the gain of the last rung of a ladder over the first, from the ratios of times in the same rounds."""
    first, *_, last = (row["samples"] for row in rows.values() if row["fractal"] == fractal)
    base = {(s["run"], s["round"]): s["kernel"] for s in first}
    ratios = [{"run": s["run"], "ratio": s["kernel"] / base[s["run"], s["round"]]} for s in last]
    runs = by_run({"samples": ratios}, "ratio")
    value, low, high = with_ends(numpy.median(sum(runs, [])), runs)
    return [1 / value, 1 / high, 1 / low]


def cost(model, rows):
    """Returns the slowest and the fastest case of a model on as many threads as the scalar kernel."""
    kinds = {name: name.partition(f"/{model}/")[0] for name, row in rows.items() if row["backend"] == model}
    speeds = [speed_up(name, f"{kind}/openmp/0/simd-width=1", rows) for name, kind in kinds.items()]
    return min(speeds) + max(speeds)


def timings():
    """Yields (file, name of a row, the page's text, function of the file's rows) for each time in the tables of the
    standard study."""
    for table in re.findall(r"^Kernel ms:\n\n((?:\|.*\n)+)", PAGE, re.M):
        (file, *applications), _, *rows = ([cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines())
        for kind, *cells in rows:
            for application, text in zip(applications, cells):
                backend, scalar, _ = application.partition("-scalar")
                name = f"{kind.replace(', ', '/')}/{backend}/0{scalar and '/simd-width=1'}"
                if "[" in text:
                    yield file, name, text, functools.partial(milliseconds, name)


def wrong(check, rows):
    """Returns true unless the numbers of the page's text are those of the rows, with three digits."""
    said = [float(number.replace(",", "")) for number in re.findall(r"\d[\d,.]*\d|\d", check[2])]
    return said != [float(f"{value:.3g}") for value in check[3](rows)]


class FiguresTest(unittest.TestCase):
    def test_the_pages_are_those_of_the_results(self):
        for path, text in results_page.pages(READ).items():
            self.assertEqual(path.read_text(encoding="utf-8"), text, f"{path}: make results-page")

    def test_figures_are_those_of_the_samples(self):
        every, day = list(timings()), datetime.date.today().isoformat()
        model = re.search(r"`stdpar` (\S+ \[.*?\] to \S+ \[.*?\])", PAGE.replace("\n", " "))[1]
        bulb, box = re.search(r"^\| all together \|  \| (.*?) \|  \| (.*?) \|$", PAGE, re.M).groups()
        checks = [
            every[0],
            ("bench.json", "mandelbulb/double/fast/stdpar/0", model, functools.partial(cost, "stdpar")),
            ("ladder.json", "mandelbulb/float/fast/openmp/0/rung=threads", bulb, functools.partial(gain, "mandelbulb")),
            ("ladder.json", "mandelbox/float/fast/openmp/0/rung=threads", box, functools.partial(gain, "mandelbox")),
            *random.Random(day).sample(every, 3),
        ]
        for check in checks:
            with self.subTest(lot=day, figure=check[:3]):
                rows = copy.deepcopy(FILES[check[0]])
                self.assertFalse(wrong(check, rows))
                for sample in rows[check[1]]["samples"]:  # the negative control: other samples in one run
                    sample |= {clock: 1.5 * sample[clock] for clock in ("kernel", "wall") if sample["run"] == 0}
                self.assertTrue(wrong(check, rows))

    def test_gains_of_rungs_multiply_to_the_whole_ladder(self):
        rungs = re.search(r"^\| kernel as scalar C\+\+ (?:.*\n)+?(?=\| all together)", PAGE, re.M)[0].splitlines()
        for column, fractal in (3, "mandelbulb"), (6, "mandelbox"):
            gains = [float(rung.split("|")[column]) for rung in rungs]
            _, low, high = gain(fractal, FILES["ladder.json"])
            self.assertTrue(low < math.prod(gains) < high, fractal)
            self.assertFalse(low < math.prod(gains) * gains[0] < high, "a rung that is counted twice is not found")


if __name__ == "__main__":
    unittest.main(verbosity=2)
