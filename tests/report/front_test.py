# SPDX-License-Identifier: Apache-2.0
"""Every number in the sentences of the front page names a file and a place in it. The number must equal the value
there, computed again from the raw samples. Each check must fail on a wrong page or file."""

from __future__ import annotations

import copy
import fnmatch
import html.parser
import math
import re
import statistics
import sys
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import front_numbers  # noqa: E402
from mandelreport.page import front_page, sections_of  # noqa: E402
from mandelreport.pictures import Cache, Studio  # noqa: E402
from mandelreport.results import Results, read_results  # noqa: E402
from mandelreport.sections import Material  # noqa: E402

# Read once, as checking the schemas takes seconds.
READ = read_results(ROOT / "report" / "results")
# 97.5th percentiles of Student's t, by degrees of freedom.
T_95 = dict(enumerate((12.7062, 4.30265, 3.18245, 2.77645, 2.57058, 2.44691, 2.36462, 2.30600, 2.26216), 1))


class Sentences(html.parser.HTMLParser):
    """Numbers in the page's elements of class `traced`. traced: numbers that name a place; loose: texts with digits
    that do not."""

    def __init__(self, page: str):
        super().__init__()
        self.open: list[tuple[str, dict[str, str]]] = []
        self.traced: list[tuple[dict[str, str], str]] = []
        self.loose: list[str] = []
        self.answers = 0
        self.feed(page)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attributes}
        self.answers += "answer" in values.get("class", "")
        if tag not in ("img", "br"):
            self.open.append((tag, values))

    def handle_endtag(self, tag: str) -> None:
        while self.open and self.open.pop()[0] != tag:
            pass

    def handle_data(self, data: str) -> None:
        tag, values = self.open[-1] if self.open else ("", {})
        if not any("traced" in of.get("class", "") for _, of in self.open):
            return
        if tag == "data":
            self.traced.append((values, data))
        elif tag != "code" and values.get("class") != "name" and re.search(r"\d", data):
            self.loose.append(data)


def walk(value: Any, keys: str) -> Any:
    for key in keys.split("."):
        value = None if value is None else value[int(key) if isinstance(value, list) else key]
    return value


def matches(entry: Any, condition: str) -> bool:
    key, sign, wanted = re.match(r"([\w.]+)(!=|=|>)(.*)", condition, re.S).groups()
    value = walk(entry, key)
    if sign == ">":
        return value is not None and value > float(wanted)
    return fnmatch.fnmatchcase("null" if value is None else str(value), wanted) is (sign == "=")


def numbers_at(data: Any, path: str) -> list[float]:
    """Returns the values at a place in a file. Medians and intervals of rows are computed from the rows' samples, not
    taken from their `figures`."""
    if isinstance(data, str):
        begin, _, index = path.rpartition(":")
        lines = [line.split() for line in data.splitlines()]
        return [float(line[int(index)]) for line in lines if len(line) > len(begin.split()) and all(map(fnmatch.fnmatchcase, line, begin.split()))]
    values = [(data, [data])]
    for step in path.split(":"):
        if re.match(r"[\w.]+(!=|=|>)", step):
            values = [(e, [*up, e]) for v, up in values for e in v if all(matches(e, c) for c in step.split("&"))]
        elif "/" in step:
            above, below = step.split("/")
            values = [(walk(v, above) / walk(v, below), up) for v, up in values]
        else:
            values = [(again(walk(v, step), step, up), [*up, step]) for v, up in values]
    return [value for value, _ in values]


def by_run(pairs: list[tuple[int, float]]) -> list[list[float]]:
    return [[value for of, value in pairs if of == run] for run in sorted({run for run, _ in pairs})]


def interval_of(runs: list[list[float]], middle: float | None = None) -> tuple[float, float]:
    """Returns the interval of several runs: Student's t on the medians' logarithms, widened to contain the median of
    all values, or `middle`."""
    logs = [math.log(statistics.median(run)) for run in runs]
    half = T_95[len(logs) - 1] * statistics.stdev(logs) / math.sqrt(len(logs))
    middle = median_of(runs) if middle is None else middle
    mean = statistics.mean(logs)
    return min(math.exp(mean - half), middle), max(math.exp(mean + half), middle)


def again(stored: Any, step: str, up: list[Any]) -> Any:
    """Returns the value of a step in a place's path: computed from the samples if possible, else as stored. Intervals
    of a single run are taken as stored."""
    row = next((e for e in up if isinstance(e, dict) and "samples" in e), None)
    entry = next((e for e in up if isinstance(e, dict) and "numerator" in e), None)
    if step == "kernel_seconds" and row is not None:
        return summarised(stored, [(s["run"], s["kernel"]) for s in row["samples"]])
    if step == "ratio" and entry is not None:
        rows = {r["name"]: {(s["run"], s["round"]): s["kernel"] for s in r["samples"]} for r in up[0]["rows"]}
        above, below = rows[entry["numerator"]], rows[entry["denominator"]]
        return summarised(stored, [(at[0], above[at] / below[at]) for at in above if at in below])
    if re.fullmatch("(speed_up|over_scalar)(_interval)?", step) and row is not None:
        serial = f"{row['fractal']}/double/exact/reference/0"
        scalar = f"{row['fractal']}/{row['precision']}/{row['mode']}/openmp/0/simd-width=1"
        base = next(r for r in up[0]["rows"] if r["name"] == (serial if step.startswith("speed_up") else scalar))
        walls = [by_run([(s["run"], s["wall"]) for s in of["samples"]]) for of in (base, row)]
        quotient = median_of(walls[0]) / median_of(walls[1])
        if not step.endswith("_interval"):
            return quotient
        ratios = [[statistics.median(a) / statistics.median(b)] for a, b in zip(*walls)]
        return list(interval_of(ratios, quotient)) if len(ratios) > 1 else stored
    return stored


def median_of(runs: list[list[float]]) -> float:
    return statistics.median([value for run in runs for value in run])


def summarised(stored: dict[str, Any], pairs: list[tuple[int, float]]) -> dict[str, Any]:
    runs = by_run(pairs)
    interval = interval_of(runs) if len(runs) > 1 else stored["interval"]
    return {"median": median_of(runs), "interval": interval and list(interval)}


def value_of(files: dict[str, Any], values: dict[str, str], end: str = "") -> float:
    found = [v for file in values[f"data-file{end}"].split() for v in numbers_at(files[file], values[f"data-path{end}"])]
    rule = values[f"data-rule{end}"]
    if rule == "holm":
        study = front_numbers.File(files[values["data-file"]])
        return front_numbers.decided([study.ratio(entry["numerator"], entry["denominator"]) for entry in found])
    if rule == "one":
        (only,) = found
        return only
    return {"count": len, "min": min, "max": max}[rule](found)


def written(value: float, style: str) -> str:
    if style in ("whole", "plain"):
        return f"{value:,.0f}" if style == "whole" else f"{value:.0f}"
    last = 3 if style == "four" else 2  # index of the last digit
    text = f"{value:.{last + 1}g}"
    shown = float(text)
    places = max(0, last - math.floor(math.log10(abs(shown)))) if shown >= 1 else 10
    return f"{shown:,.{places}f}" if shown >= 1 else f"{shown:.10f}".rstrip("0")


def faults(page: str, files: dict[str, Any]) -> list[str]:
    """Returns a line for each number that does not name a place, or differs from the value at its place."""
    sentences = Sentences(page)
    found = [f"no place: {text.strip()}" for text in sentences.loose]
    for values, text in sentences.traced:
        value = float(values["data-scale"]) * value_of(files, values)
        if "data-path-over" in values:
            value /= value_of(files, values, "-over")
        if written(value, values["data-style"]) != text:
            found.append(f"{values['data-file']}: {values['data-path']} is {value}, the page says {text}")
    return found


def page_of(results: Results) -> str:
    none = Path("/nonexistent")
    return front_page(Material(results, Studio(none, Cache(none)), none))


class FrontTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.results = READ
        cls.page = page_of(cls.results)

    def test_every_number_is_that_of_its_file(self) -> None:
        sentences = Sentences(self.page)
        self.assertEqual(sentences.answers, 8)  # seven questions, one of them in two parts
        self.assertGreater(len(sentences.traced), 50)
        self.assertEqual(faults(self.page, self.results.files), [])

    def test_another_file_is_seen(self) -> None:
        files = copy.deepcopy(self.results.files)
        rows = files[self.results.primary().name]["rows"]
        row = next(r for r in rows if r["name"] == "mandelbox/double/exact/openmp/0")
        for sample in row["samples"]:
            sample["kernel"] *= 1.05
        self.assertTrue(any("mandelbox/double/exact/openmp/0" in fault for fault in faults(self.page, files)))

    def test_an_interval_that_is_not_of_the_runs_is_seen(self) -> None:
        results = copy.deepcopy(READ)
        for entry in results.primary().ratios("others_to_host"):
            entry["ratio"]["interval"][0] *= 1.01
        wrong = faults(page_of(results), results.files)
        self.assertEqual(len(wrong), 2, wrong)
        self.assertIn("interval:0", wrong[0])

    def test_numbers_without_a_place_are_seen(self) -> None:
        loose = self.page.replace('<p class="traced answer">', '<p class="traced answer">7.5 times ', 1)
        self.assertEqual(len(faults(loose, self.results.files)), 1)
        other = re.sub(r"(<data[^>]*>)[\d.,]+<", r"\g<1>4.44<", self.page, count=1)
        self.assertEqual(len(faults(other, self.results.files)), 1)

    def test_no_data_says_what_makes_it(self) -> None:
        page = page_of(Results())
        self.assertEqual(page.count("No data yet:"), 7)
        self.assertEqual(Sentences(page).traced, [])

    def test_a_backend_that_beats_the_host_is_not_hidden(self) -> None:
        results = copy.deepcopy(READ)
        bench = results.primary()
        for entry in bench.ratios("others_to_host"):
            entry["ratio"]["median"] /= 10
        self.assertIn("No backend is shown to be the fastest everywhere.", page_of(results))
        self.assertNotIn("No backend is shown to be the fastest everywhere.", self.page)

    def test_a_gpu_that_was_measured_is_not_predicted(self) -> None:
        self.assertIn("No GPU was measured.", self.page)
        results = copy.deepcopy(READ)
        for row in results.primary().data["rows"]:
            if row["backend"] == "vulkan":
                row |= {"is_gpu": True, "device_name": "Card 9"}
        page = page_of(results)
        self.assertNotIn("No GPU was measured.", page)
        self.assertIn('Measured on <span class="name">Card 9</span>', page)
        self.assertEqual(faults(page, results.files), [])


class MainTest(unittest.TestCase):
    """The sentences about results in the main part of the report: answers, and notes on diagrams."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.results = READ
        none = Path("/nonexistent")
        cls.page = sections_of(Material(cls.results, Studio(none, Cache(none)), none), ["method", "speed", "why", "parallel"])

    def test_every_number_is_that_of_its_file(self) -> None:
        self.assertGreater(len(Sentences(self.page).traced), 25)
        self.assertEqual(faults(self.page, self.results.files), [])

    def test_another_file_is_seen(self) -> None:
        files = copy.deepcopy(self.results.files)
        for data in files.values():
            for row in data.get("rows", []) if isinstance(data, dict) and "counts" in data else []:
                row["operations"] *= 1.05 if row["fractal"] == "mandelbox" else 1
        self.assertTrue(any(":operations/work.iterations" in fault for fault in faults(self.page, files)))

    def test_a_number_without_a_place_is_seen(self) -> None:
        loose = self.page.replace('<span class="traced">', '<span class="traced">7.5 times ', 1)
        self.assertEqual(len(faults(loose, self.results.files)), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
