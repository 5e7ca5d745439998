# SPDX-License-Identifier: Apache-2.0
"""Reads result files for tools/figures.py, each once, into the report's classes."""
import json
import os
import pathlib
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
from mandelreport.bench import Bench  # noqa: E402

FRACTALS = {"bulb": "mandelbulb", "box": "mandelbox"}


class FigureError(Exception):
    """An error in a place or in a result file, in one line."""


def digits(value):
    """Formats a value with four significant digits."""
    return f"{value:#.4g}".rstrip(".")


def with_interval(value, interval, form="{:.2f}".format):
    """Formats "1.23 [1.20, 1.26]"; without an interval the value alone."""
    return form(value) + ("" if interval is None else " [" + ", ".join(map(form, interval)) + "]")


class Results:
    """The result files of a folder. Names are relative paths without .json."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.read = {}

    def text(self, name):
        try:
            return (self.folder / name).read_text(encoding="utf-8")
        except OSError as error:
            raise FigureError(f"{name}: {error.strerror}") from None

    def json(self, name):
        if name not in self.read:
            try:
                self.read[name] = json.loads(self.text(name + ".json"))
            except ValueError as error:
                raise FigureError(f"{name}.json: no JSON: {error}") from None
        return self.read[name]

    def bench(self, name):
        return Bench(name, self.folder / f"{name}.json", self.json(name))

    def rows(self, name):
        """Returns all timed configurations of a study."""
        return [row for row in self.bench(name).all_rows if row.timed]

    def row(self, name, fractal, precision, mode, *more):
        """Returns one timed configuration: fractal (bulb, box), precision, mode, and in any order a backend (default
        openmp) and a sweep value."""
        value = next((word for word in more if "=" in word), "")
        backend = next((word for word in more if "=" not in word), "openmp")
        key = (FRACTALS.get(fractal, fractal), precision, mode, backend, value, 0)
        found = [row for row in self.rows(name) if (*row.kind, row.backend, row.sweep_value, row.device) == key]
        if not found:
            raise FigureError(f"{name}.json has no timed row {' '.join(filter(None, key[:-1]))}")
        return found[0]

    def ratio(self, name, question, row):
        """Returns (median, interval or None) of a configuration's ratio of kernel times, paired by round."""
        found = self.bench(name).ratio(question, row.name)
        if found is None:
            raise FigureError(f"{name}.json says nothing of {row.name} in {question}")
        return found["ratio"]["median"], found["ratio"]["interval"]
