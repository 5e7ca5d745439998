# SPDX-License-Identifier: Apache-2.0
"""Mandelbox compared with Mandelbulb, and the cost of double."""

import math
from dataclasses import dataclass
from typing import Any

from .. import charts
from ..bench import Backends, Bench, Row, Times
from ..blocks import Figure, Missing, Table, seen
from ..text import digits, ms, percent
from . import Material

NAMES = ("DE evaluations per pixel", "iterations per DE evaluation", "operations per iteration", "idle lanes (sample)", "all four", "measured time")
FRACTALS = ("mandelbox", "mandelbulb")


@dataclass(frozen=True)
class Factors:
    """The factors of a picture's operations per pixel. DE evaluations and iterations are counted over all pixels,
    operations per iteration and active lanes in a sample of the pixels, whose counts are `sample`."""

    row: Row
    sample: dict[str, Any]
    calls: float  # DE evaluations per pixel
    iterations: float  # per DE evaluation
    operations: float  # per iteration

    @property
    def view(self) -> str:
        return self.row.setting["view"]

    @property
    def lanes(self) -> dict[str, Any]:
        return self.sample["lane_use"][0]

    @property
    def kernel(self) -> float | None:
        """Returns seconds per picture."""
        return self.row.kernel.median if self.row.timed else None


def factors(bench: Bench, backend: str) -> list[Factors]:
    """Returns the factors of every scene of the study box-vs-bulb that `backend` rendered, in the order of its rows."""
    samples = {(count["fractal"], count["precision"], count["setting"]["view"]): count for count in bench.data["counts"]}
    rows = {(row.fractal, row.precision, row.setting["view"]): row for row in bench.rows if row.backend == backend}
    return [
        Factors(
            row,
            samples[key],
            row.work["de_calls"] / math.prod(row.size),
            row.work["iterations"] / row.work["de_calls"],
            row.operations / row.work["iterations"],
        )
        for key, row in rows.items()
        if key in samples and row.work["iterations"]
    ]


def factor_table(material: Material) -> Table | None:
    """Returns a table of the factors of a picture's operations, with a line for each scene in all studies
    box-vs-bulb."""
    found = [(bench.name, f) for bench in material.results.study("box-vs-bulb") for f in factors(bench, material.backends.host)]
    rows = [
        [
            name,
            f.row.fractal,
            f.view,
            f.row.precision,
            digits(f.calls),
            digits(f.iterations),
            digits(f.operations),
            digits(f.calls * f.iterations * f.operations, 4),
            digits(f.sample["work"]["de_calls"] / f.sample["pixels"] / f.calls),
            percent(f.lanes["together"]["in_steps"], 0),
            percent(f.lanes["together"]["in_iterations"], 0),
            "–" if f.kernel is None else ms(f.kernel),
            percent(f.row.figures["share_of_peak"] if f.row.timed else None),
        ]
        for name, f in found
    ]
    if not rows:
        return None
    return Table(
        [
            "file",
            "fractal",
            "scene",
            "precision",
            "DE evaluations per pixel",
            "iterations per DE evaluation",
            "operations per iteration",
            "operations per pixel",
            "DE evaluations, sample / picture",
            "active lanes, steps",
            "active lanes, iterations",
            "kernel ms",
            "share of peak",
        ],
        rows,
        "Cost of a picture of each scene. Evaluations of the distance estimator (DE) and iterations are counted over all pixels; "
        f"operations per iteration and active lanes (of {found[0][1].lanes['lanes']} neighbouring pixels that continue until the last one is done) in a "
        f"sample of {found[0][1].sample['pixels']:,} pixels. Sample / picture: DE evaluations per pixel in the sample over those in the complete picture; "
        "if this is far from 1, the sample is not representative.",
        list(range(4, 13)),
    )


def _comparison(pairs: list[tuple[Factors, Factors]]) -> Figure:
    """Shows each factor of the Mandelbox divided by the Mandelbulb's, with a mark for each scene."""
    dots = []
    for number, (box, bulb) in enumerate(pairs):
        active = [f.lanes["together"]["in_iterations"] for f in (bulb, box)]
        parts = [box.calls / bulb.calls, box.iterations / bulb.iterations, box.operations / bulb.operations, active[0] / active[1]]
        values = [*parts, math.prod(parts), *([box.kernel / bulb.kernel] if box.kernel and bulb.kernel else [])]
        dots += [charts.Dot("", name, Times(value, None), number, number, f"{box.view}, {name}", box.view) for name, value in zip(NAMES, values)]
    return charts.block(
        charts.dots(dots, NAMES, "Mandelbox / Mandelbulb, logarithmic", base=2),
        "Points on a logarithmic scale, Mandelbox over Mandelbulb. " + charts.values_of(dots),
        "Mandelbox over Mandelbulb, factor by factor and scene by scene (in double; above 1: the Mandelbox does more). Idle lanes: the "
        "Mandelbulb's fraction of active lanes over the Mandelbox's. DE evaluations and iterations are counted over all pixels, operations and "
        f"lanes in a sample of {pairs[0][0].sample['pixels']:,} pixels of each picture. The fifth line is the product of the first four.",
    )


def double_to_float(bench: Bench, backends: Backends) -> Figure | None:
    """Shows the kernel time in double divided by that in float, with a line for each backend and a panel for each
    fractal."""
    dots = [
        charts.Dot(
            row.fractal,
            row.label,
            ratio.times,
            backends.number_of(row.backend),
            int(row.mode == "fast"),
            f"{row.fractal}, {row.mode}, {row.label}",
            filled=row.mode == "exact",
        )
        for ratio in bench.ratios("double_to_float")
        for row in [bench.named(ratio.numerator)]
    ]
    return None if not dots else charts.block(
        charts.dots(dots, backends.order(dot.name for dot in dots), "time in double / time in float"),
        "Points with intervals: time in double over that in float. " + charts.values_of(dots),
        f"Kernel time in double over that in float, round by round, with 95 % intervals ({bench.name}). Filled marks: exact mode; open marks: "
        "fast mode.",
    )


def _study(material: Material, bench: Bench) -> Figure | None:
    found = factors(bench, material.backends.host)
    views: dict[str, dict[str, Factors]] = {}
    for f in found:
        if f.row.precision == "double":
            views.setdefault(f.view, {})[f.row.fractal] = f
    pairs = [(of["mandelbox"], of["mandelbulb"]) for of in views.values() if set(FRACTALS) <= set(of)]
    return seen(_comparison(pairs), _see(pairs)) if pairs else None


def _see(pairs: list[tuple[Factors, Factors]]) -> str:
    """Returns a sentence that names the scene in which the Mandelbox takes longest, compared with the Mandelbulb."""
    box, bulb = max(pairs, key=lambda pair: (pair[0].kernel or 0) / (pair[1].kernel or 1))
    if not box.kernel or not bulb.kernel:
        return ""
    return (
        f"the scene decides which fractal is slower: {box.view} has the largest ratio. The Mandelbox's iterations are cheaper, but "
        "each DE evaluation has more of them. The rest, between all four factors and the measured time, is how close each loop comes to the peak."
    )


def why(material: Material) -> dict[str, Any]:
    primary, backends = material.answers.primary, material.backends
    figure = double_to_float(primary, backends) if primary else None
    studies = material.results.study("box-vs-bulb")
    # Takes the study with the most backends and, of several such studies, the one with the most rows.
    first = max(studies, key=lambda bench: (len(bench.values("backend")), len(bench.rows)), default=None)
    return {
        "study": _study(material, first) if first else None,
        "missing": Missing("The answer", "bin/bench --study box-vs-bulb --json results/box-vs-bulb.json"),
        "ratios": seen(
            figure,
            "a register holds two floats per double, and the estimators' loops have more instructions in double "
            "(Appendix B): together a factor of more than two if a backend uses SIMD. Scalar code gains less.",
        ),
    }
