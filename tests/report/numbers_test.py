# SPDX-License-Identifier: Apache-2.0
"""Checks of the finished front page: front_numbers.py computes each number again, and the product of the printed factors is
the printed product. Each check must fail on a wrong page or number."""

from __future__ import annotations

import math
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
RESULTS = ROOT / "report" / "results"
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

from front_numbers import faults, is_written, text_of  # noqa: E402
from mandelreport.page import front_page, sections_of  # noqa: E402
from mandelreport.pictures import Cache, Studio  # noqa: E402
from mandelreport.results import read_results  # noqa: E402
from mandelreport.sections import Material  # noqa: E402

NONE = Path("/nonexistent")
MATERIAL = Material(read_results(RESULTS), Studio(NONE, Cache(NONE)), NONE)
FRONT = front_page(MATERIAL)
FACTORS = re.compile(
    r"([\d.]+) times as many evaluations.*?([\d.]+) times as many iterations.*?([\d.]+) times as many operations.*?product is ([\d.]+) times", re.S
)


def multiply(printed: list[str]) -> bool:
    """Returns true if the last number is the product of the others, within their printed digits."""
    *factors, product = map(float, printed)
    slack = sum(0.5 * 10.0 ** -len(text.partition(".")[2]) / float(text) for text in printed)
    return abs(math.prod(factors) / product - 1) <= slack


class NumbersTest(unittest.TestCase):
    def test_every_number_of_the_front_page_is_computed_again(self) -> None:
        self.assertEqual(faults(FRONT, RESULTS), [])

    def test_each_number_that_is_changed_is_seen(self) -> None:
        numbers = list(re.finditer(r"(?<=>)[\d,.]*\d(?=</data>)", FRONT))
        self.assertGreater(len(numbers), 90)
        for number in numbers:
            value = float(number[0].replace(",", ""))
            other = f"{FRONT[: number.start()]}{value * 1.03 + 0.01:.5f}{FRONT[number.end() :]}"
            self.assertNotEqual(faults(other, RESULTS), [], number[0])

    def test_a_number_that_nothing_computes_is_seen(self) -> None:
        self.assertEqual(len(faults(FRONT.replace("It was made once", "It was made once, in 12 parts"), RESULTS)), 1)

    def test_a_sentence_that_is_missing_is_seen(self) -> None:
        self.assertIn("the page does not say", " ".join(faults(FRONT.replace("times as many evaluations", "more evaluations"), RESULTS)))

    def test_rounding_is_checked_to_the_last_digit(self) -> None:
        self.assertTrue(is_written("1.76", 1.7602) and is_written("1,138", 1137.99) and is_written("2", 2))
        self.assertFalse(is_written("1.76", 1.7657) or is_written("1,138", 1139.1) or is_written("48", 47))


class FactorsTest(unittest.TestCase):
    """The factors that explain why one fractal is slower: DE evaluations x iterations x operations. They are on the
    front page and, for both precisions, in the section `why`."""

    def test_printed_factors_multiply_to_the_printed_product(self) -> None:
        found = FACTORS.findall(text_of(FRONT)) + FACTORS.findall(text_of(sections_of(MATERIAL, ["why"])))
        self.assertEqual(len(found), 3)
        for printed in found:
            self.assertTrue(multiply(printed), printed)

    def test_factors_of_a_sample_and_work_of_all_pixels_do_not(self) -> None:
        self.assertFalse(multiply(["1.37", "3.99", "0.359", "1.76"]))
        self.assertFalse(multiply(["1.33", "3.99", "0.359", "1.76"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
