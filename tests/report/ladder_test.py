#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ladder_test.py FILE: in a result of `bench --study ladder`, the gains of the rungs multiply to the gain of the whole
ladder. Everything is computed from the file's samples, without the project's code."""
import copy
import json
import math
import statistics
import sys
import unittest

PATH = sys.argv.pop() if len(sys.argv) > 1 else ""


def rungs(data, fractal):
    """Returns, for each rung in order, the kernel times in seconds by (run, round)."""
    rows = [row for row in data["rows"] if row["fractal"] == fractal]
    return [{(s["run"], s["round"]): s["kernel"] for s in row["samples"]} for row in rows]


def gain(before, after):
    """Returns how many times as fast `after` is: the median of the ratios in the rounds that both have."""
    return statistics.median(before[at] / after[at] for at in before if at in after)


def published(data, question, fractal):
    """Returns the ratios that answer a question: each rung's time divided by that of an earlier rung."""
    return [one["ratio"] for one in data["questions"][question] if one["numerator"].startswith(f"{fractal}/")]


def outside(data, fractal):
    """Returns the product of the published gains of the rungs if it lies outside the interval of the whole ladder's
    gain, otherwise None."""
    product = math.prod(1 / ratio["median"] for ratio in published(data, "to_previous_value", fractal))
    low, high = (1 / end for end in reversed(published(data, "to_first_value", fractal)[-1]["interval"]))
    return None if low <= product <= high else product


class LadderTest(unittest.TestCase):
    def setUp(self):
        with open(PATH, encoding="utf-8") as file:
            self.data = json.load(file)
        self.fractals = sorted({row["fractal"] for row in self.data["rows"]})

    def test_published_gains_are_those_of_the_samples(self):
        for fractal in self.fractals:
            times = rungs(self.data, fractal)
            steps = [gain(before, after) for before, after in zip(times, times[1:])]
            for own, ratio in zip(steps, published(self.data, "to_previous_value", fractal), strict=True):
                # Approximately equal, because the median of inverse ratios is not exactly the inverse of the median.
                self.assertAlmostEqual(own * ratio["median"], 1, 2, fractal)
            whole = gain(times[0], times[-1])
            self.assertAlmostEqual(whole * published(self.data, "to_first_value", fractal)[-1]["median"], 1, 2, fractal)

    def test_gains_multiply_to_the_whole(self):
        for fractal in self.fractals:
            self.assertIsNone(outside(self.data, fractal), fractal)

    def test_a_rung_that_is_counted_twice_is_found(self):
        for fractal in self.fractals:
            wrong = copy.deepcopy(self.data)
            ratio = published(wrong, "to_previous_value", fractal)[0]
            ratio["median"] **= 2
            self.assertIsNotNone(outside(wrong, fractal), fractal)


if __name__ == "__main__":
    unittest.main()
