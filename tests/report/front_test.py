# SPDX-License-Identifier: Apache-2.0
"""Every number in the sentences of the report names a file and a place in it, and equals the value at that place.
front_numbers.py computes each number of the front page again. Each check must fail if the page or a file is wrong."""

from __future__ import annotations

import copy
import html.parser
import math
import re
import sys
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from unittest import mock

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import front_numbers  # noqa: E402
from mandelreport.page import front_page, sections_of  # noqa: E402
from mandelreport.pictures import Cache, Studio  # noqa: E402
from mandelreport.results import Results, read_results  # noqa: E402
from mandelreport.sections import Material  # noqa: E402

RESULTS = ROOT / "results"
# The results, read only once, because checking their schemas takes seconds.
READ = read_results(RESULTS)


class Sentences(html.parser.HTMLParser):
    """The numbers in a page's sentences, which are in elements of class `traced`. `traced`: the numbers that name a
    place; `loose`: texts with digits that name none."""

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


def number_at(files: dict[str, Any], place: str) -> float:
    """Returns the number at a place, which is given as FILE#POINTER."""
    name, _, pointer = place.partition("#")
    steps = pointer.split("/")[1:]
    value = files[name]
    if isinstance(value, str):
        return float(value.splitlines()[int(steps[0])].split()[int(steps[1])])
    for step in steps:
        value = value[int(step) if isinstance(value, list) else step]
    return value


PLACE = re.compile(r"[\w./-]+#[\w/-]+")


def value_of(files: dict[str, Any], source: str) -> float:
    """Returns the value of a source. A source is a formula of places, or count(...), the number of places in it."""
    places = PLACE.findall(source)
    if source.startswith("count("):
        return len(places)
    return eval(PLACE.sub(lambda place: repr(number_at(files, place[0])), source))  # pylint: disable=eval-used


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
        value = value_of(files, values["data-from"])
        if written(value, values["data-style"]) != text:
            found.append(f"{values['data-from']} is {value}, the page says {text}")
    return found


def material_of(results: Results) -> Material:
    none = Path("/nonexistent")
    return Material(results, Studio(none, Cache(none)), none)


def page_of(results: Results, sections: Sequence[str] = ("method", "speed", "why", "parallel", "film")) -> str:
    """Returns the front page, followed by those sections of the main part that have sentences about results. The
    figures are empty, because drawing them takes most of the time."""
    material = material_of(results)
    with mock.patch("matplotlib.figure.Figure.savefig"):
        return front_page(material) + sections_of(material, sections)


class FrontTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.results = READ
        cls.page = page_of(cls.results)

    def test_every_number_is_that_of_its_file(self) -> None:
        sentences = Sentences(self.page)
        self.assertEqual(sentences.answers, 8)  # seven questions, one of them in two parts
        self.assertGreater(len(sentences.traced), 75)
        self.assertEqual(faults(self.page, self.results.files), [])

    def test_another_file_is_seen(self) -> None:
        files = copy.deepcopy(self.results.files)
        for entry in files[self.results.primary().name]["questions"]["mandelbox_to_mandelbulb"]:
            entry["ratio"]["interval"][0] *= 0.95
        self.assertTrue(any("/mandelbox_to_mandelbulb/" in fault for fault in faults(self.page, files)))

    def test_numbers_without_a_place_are_seen(self) -> None:
        loose = self.page.replace('<p class="traced answer">', '<p class="traced answer">7.5 times ', 1)
        self.assertEqual(len(faults(loose, self.results.files)), 1)
        other = re.sub(r"(<data[^>]*>)[\d.,]+<", r"\g<1>4.44<", self.page, count=1)
        self.assertEqual(len(faults(other, self.results.files)), 1)

    def test_no_data_says_what_makes_it(self) -> None:
        page = page_of(Results())
        self.assertGreaterEqual(page.count("No data yet:"), 8)
        self.assertEqual(Sentences(page).traced, [])

    def test_a_backend_that_beats_the_host_is_not_hidden(self) -> None:
        results = copy.deepcopy(READ)
        bench = results.primary()
        bench.data["winners"][0]["fastest"] = "mandelbulb/double/exact/vulkan/0"
        self.assertIn("No backend is shown to be the fastest everywhere.", page_of(results))
        self.assertNotIn("No backend is shown to be the fastest everywhere.", self.page)

    def test_a_gpu_is_named_only_if_it_was_measured(self) -> None:
        self.assertIn("on <span class=\"name\">NVIDIA H100", self.page)
        results = copy.deepcopy(READ)
        for row in (row for bench in results.benches for row in bench.data["rows"]):
            row["is_gpu"] = False
        page = page_of(results)
        self.assertNotIn("NVIDIA H100", page)
        self.assertIn("make gpu-results", page)


class NumbersTest(unittest.TestCase):
    """The numbers of the front page, computed again."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.page = page_of(READ, [])

    def test_every_number_of_the_front_page_is_computed_again(self) -> None:
        self.assertEqual(front_numbers.faults(self.page, RESULTS), [])

    def test_each_number_that_is_changed_is_seen(self) -> None:
        numbers = list(re.finditer(r"(?<=>)[\d,.]*\d(?=</data>)", self.page))
        self.assertGreater(len(numbers), 90)
        for number in numbers:
            value = float(number[0].replace(",", ""))
            other = f"{self.page[: number.start()]}{value * 1.03 + 0.01:.5f}{self.page[number.end() :]}"
            self.assertNotEqual(front_numbers.faults(other, RESULTS), [], number[0])

    def test_a_number_that_nothing_computes_is_seen(self) -> None:
        self.assertEqual(len(front_numbers.faults(self.page.replace("It was made once", "It was made once, in 12 parts"), RESULTS)), 1)

    def test_a_sentence_that_is_missing_is_seen(self) -> None:
        other = self.page.replace("times as many evaluations", "more evaluations")
        self.assertIn("the page does not say", " ".join(front_numbers.faults(other, RESULTS)))

    def test_rounding_is_checked_to_the_last_digit(self) -> None:
        written = front_numbers.is_written
        self.assertTrue(written("1.76", 1.7602) and written("1,138", 1137.99) and written("2", 2))
        self.assertFalse(written("1.76", 1.7657) or written("1,138", 1139.1) or written("48", 47))


if __name__ == "__main__":
    unittest.main(verbosity=2)
