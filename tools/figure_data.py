# SPDX-License-Identifier: Apache-2.0
"""Result files for tools/figures.py: timed rows of bench, random scenes, text files."""
import json
import os

FRACTALS = {"bulb": "mandelbulb", "box": "mandelbox"}


class FigureError(Exception):
    """An error in a place or in a result file, in one line."""


def digits(value):
    """Formats a value with four significant digits."""
    return f"{value:#.4g}".rstrip(".")


def with_interval(value, interval, form="{:.2f}".format):
    """Formats "1.23 [1.20, 1.26]"; without an interval the value alone."""
    return form(value) + ("" if interval is None else " [" + ", ".join(map(form, interval)) + "]")


class Row:
    """A timed configuration of bench."""

    def __init__(self, data):
        self.data = data
        self.figures = data["figures"]

    def __getitem__(self, key):
        return self.data[key]

    @property
    def kernel_ms(self):
        return 1e3 * self.figures["kernel_seconds"]["median"]

    @property
    def interval_ms(self):
        """Returns the interval of the kernel time, or None."""
        interval = self.figures["kernel_seconds"]["interval"]
        return interval and [1e3 * end for end in interval]

    @property
    def wall_ms(self):
        return 1e3 * self.figures["wall_seconds"]["median"]

    @property
    def off_percent(self):
        verification = self.data["verification"]
        return 100 * verification["visibly_differing"] / verification["pixels"]


class Results:
    """The result files of a folder, each read once. Names are relative paths without .json."""

    def __init__(self, folder):
        self.folder = folder
        self.read = {}

    def text(self, name):
        try:
            with open(os.path.join(self.folder, name), encoding="utf-8") as file:
                return file.read()
        except OSError as error:
            raise FigureError(f"{name}: {error.strerror}") from None

    def json(self, name):
        if name not in self.read:
            try:
                self.read[name] = json.loads(self.text(name + ".json"))
            except ValueError as error:
                raise FigureError(f"{name}.json: no JSON: {error}") from None
        return self.read[name]

    def rows(self, name):
        """Returns all timed configurations of a study."""
        return [Row(row) for row in self.json(name)["rows"] if row["figures"] is not None]

    def row(self, name, fractal, precision, mode, *more):
        """Returns one timed configuration: fractal (bulb, box), precision, mode, and in any order a backend (default
        openmp) and a sweep value."""
        value = next((word for word in more if "=" in word), "")
        backend = next((word for word in more if "=" not in word), "openmp")
        fractal = FRACTALS.get(fractal, fractal)
        key = {"fractal": fractal, "precision": precision, "mode": mode, "backend": backend, "sweep_value": value, "device": 0}
        found = [row for row in self.rows(name) if all(row[k] == v for k, v in key.items())]
        if not found:
            words = " ".join(filter(None, (fractal, precision, mode, backend, value)))
            raise FigureError(f"{name}.json has no timed row {words}")
        return found[0]

    def work_over_scalar(self, name, row):
        """Returns a configuration's counted operations over those of openmp's scalar kernel, or None if one is
        unknown."""
        try:
            scalar = self.row(name, row["fractal"], row["precision"], row["mode"], "simd-width=1")
        except FigureError:
            return None
        return row["operations"] / scalar["operations"] if row["operations"] and scalar["operations"] else None

    def ratio(self, name, question, row):
        """Returns (median, interval or None) of a configuration's ratio of kernel times, paired by round."""
        for entry in self.json(name)["questions"][question]:
            if entry["numerator"] == row["name"] and entry["ratio"]["count"]:
                return entry["ratio"]["median"], entry["ratio"]["interval"]
        raise FigureError(f"{name}.json says nothing of {row['name']} in {question}")

    def peak(self, name, precision):
        """Returns the machine's measured multiply-add peak, in operations per second."""
        return max(p["operations_per_second"] for p in self.json(name)["peaks"] if p["precision"] == precision)
