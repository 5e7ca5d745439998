# SPDX-License-Identifier: Apache-2.0
"""Why the Mandelbox is, or is not, slower than the Mandelbulb, and what double costs."""

from __future__ import annotations

import dataclasses
from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from ..figures import timings
from ..figures.why import Factors, comparison, factors
from ..text import digits, ms, percent
from . import Material

FRACTALS = ("mandelbox", "mandelbulb")


def factor_table(material: Material) -> Table | None:
    """What a picture of each scene of every such study costs."""
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
            "number",
            "calls a pixel",
            "iterations a call",
            "operations an iteration",
            "operations a pixel",
            "busy lanes, steps",
            "busy lanes, iterations",
            "kernel ms",
            "of peak",
        ],
        rows,
        "What a picture of each scene costs. Calls: of the distance estimator. Busy lanes: of "
        f"{found[0][1].lanes} neighbouring pixels that go on until the last is done.",
        list(range(4, 12)),
    )


def _answer(bench: Bench, found: list[Factors], precision: str, host: str) -> dict[str, Any] | None:
    """The official scenes' factors in words' numbers."""
    of = {f.fractal: f for f in found if f.view == "official" and f.precision == precision}
    if set(of) != set(FRACTALS):
        return None
    box, bulb = of["mandelbox"], of["mandelbulb"]
    if box.kernel is None or bulb.kernel is None:
        return None
    ratio = box.kernel / bulb.kernel
    angles = next((f for f in found if f.view == "angles" and f.precision == precision), None)
    answer: dict[str, Any] = {
        "precision": precision,
        "machine": bench.machine,
        "backend": host,
        "ratio": digits(ratio),
        "slower": ratio > 1,
        "close": 0.95 < ratio < 1.05,
        "calls": digits(box.calls / bulb.calls),
        "iterations": digits(box.iterations / bulb.iterations),
        "operations": digits(bulb.operations / box.operations),
        "work": digits(box.per_pixel / bulb.per_pixel),
        "box_lanes": percent(box.active, 0),
        "bulb_lanes": percent(bulb.active, 0),
        "box_peak": percent(box.share_of_peak, 0),
        "bulb_peak": percent(bulb.share_of_peak, 0),
        "more_work": box.per_pixel > bulb.per_pixel,
    }
    if angles is not None and angles.kernel is not None:
        answer["angles"] = digits(angles.kernel / bulb.kernel)
        answer["angle_operations"] = digits(angles.operations / bulb.operations)
        answer["against_angles"] = digits(box.kernel / angles.kernel)
        answer["box_beats_angles"] = box.kernel < angles.kernel
    return answer


def _study(bench: Bench, host: str) -> dict[str, Any]:
    found = factors(bench, host)
    views: dict[str, dict[str, Factors]] = {}
    for f in found:
        if f.precision == "double":
            views.setdefault(f.view, {})[f.fractal] = f
    pairs = [(of["mandelbox"], of["mandelbulb"]) for of in views.values() if set(FRACTALS) <= set(of)]
    figure = comparison(pairs)
    return {
        "answers": [a for p in ("double", "float") if (a := _answer(bench, found, p, host))],
        "figure": figure and dataclasses.replace(figure, see=_see(pairs)),
    }


def _see(pairs: list[tuple[Factors, Factors]]) -> str:
    """How far the four factors are from the measured ratio, and which scene has the largest."""
    box, bulb = max(pairs, key=lambda pair: (pair[0].kernel or 0) / (pair[1].kernel or 1))
    if not box.kernel or not bulb.kernel:
        return ""
    return (
        f"which fractal is slower is a question of the scene: {box.view} has the largest ratio, {digits(box.kernel / bulb.kernel)}. More iterations a "
        "call cost the Mandelbox what cheaper iterations save. What is left between all four and the measured time is how near each loop comes to the peak."
    )


def section(material: Material) -> dict[str, Any]:
    primary, backends = material.answers.primary, material.backends
    ratio = primary and timings.ratios(
        primary,
        backends,
        "double_to_float",
        "double / float, kernel time",
        f"How many times longer double takes, round by round, with 95 % intervals ({primary.name}).",
    )
    studies = material.results.study("box-vs-bulb")
    # The study that asked most backends, in both numbers.
    first = max(studies, key=lambda bench: (len(bench.values("backend")), len(bench.rows)), default=None)
    return {
        "study": _study(first, backends.host) if first else None,
        "missing": Missing("The answer", "bin/bench --study box-vs-bulb --json report/results/box-vs-bulb.json"),
        "ratios": ratio
        and dataclasses.replace(
            ratio,
            see="a register holds two floats for a double, and the estimators' loops have more instructions in double (Appendix B): together "
            "that is more than two where a backend uses SIMD. OpenACC's host fallback is scalar and gains less.",
        ),
    }
