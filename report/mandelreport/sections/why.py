# SPDX-License-Identifier: Apache-2.0
"""Mandelbox compared with Mandelbulb, and the cost of double."""

from typing import Any

from ..bench import Bench
from ..blocks import Figure, Missing, Table, seen
from ..figures import timings
from ..figures.why import Factors, comparison, factors
from ..text import digits, ms, percent
from . import Material

FRACTALS = ("mandelbox", "mandelbulb")


def factor_table(material: Material) -> Table | None:
    """Returns a table of the factors of a picture's operations, with a line for each scene in all studies
    box-vs-bulb."""
    found = [(bench.name, f) for bench in material.results.study("box-vs-bulb") for f in factors(bench, material.backends.host)]
    rows = [
        [
            name,
            f.fractal,
            f.view,
            f.precision,
            digits(f.calls),
            digits(f.iterations),
            digits(f.operations),
            digits(f.per_pixel, 4),
            digits(f.sampled_calls / f.calls),
            percent(f.active_steps, 0),
            percent(f.active, 0),
            "–" if f.kernel is None else ms(f.kernel),
            percent(f.share_of_peak),
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
        f"operations per iteration and active lanes (of {found[0][1].lanes} neighbouring pixels that continue until the last one is done) in a "
        f"sample of {found[0][1].sample:,} pixels. Sample / picture: DE evaluations per pixel in the sample over those in the complete picture; "
        "if this is far from 1, the sample is not representative.",
        list(range(4, 13)),
        name="factors",
    )


def _study(material: Material, bench: Bench) -> Figure | None:
    found = factors(bench, material.backends.host)
    views: dict[str, dict[str, Factors]] = {}
    for f in found:
        if f.precision == "double":
            views.setdefault(f.view, {})[f.fractal] = f
    pairs = [(of["mandelbox"], of["mandelbulb"]) for of in views.values() if set(FRACTALS) <= set(of)]
    figure = comparison(pairs)
    return figure and seen(figure, _see(pairs))


def _see(pairs: list[tuple[Factors, Factors]]) -> str:
    """Returns a sentence that names the scene in which the Mandelbox takes longest, compared with the Mandelbulb."""
    box, bulb = max(pairs, key=lambda pair: (pair[0].kernel or 0) / (pair[1].kernel or 1))
    if not box.kernel or not bulb.kernel:
        return ""
    return (
        f"the scene decides which fractal is slower: {box.view} has the largest ratio. The Mandelbox's iterations are cheaper, but "
        "each DE evaluation has more of them. The rest, between all four factors and the measured time, is how close each loop comes to the peak."
    )


def section(material: Material) -> dict[str, Any]:
    primary, backends = material.answers.primary, material.backends
    figure = primary and timings.double_to_float(primary, backends)
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
