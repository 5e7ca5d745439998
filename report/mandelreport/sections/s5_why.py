# SPDX-License-Identifier: Apache-2.0
"""Section 5: why the Mandelbox is, or is not, slower than the Mandelbulb."""

from __future__ import annotations

from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from ..figures.why import Factors, comparison, factors
from ..text import digits, ms, percent
from . import Material

FRACTALS = ("mandelbox", "mandelbulb")


def _table(found: list[Factors]) -> Table:
    rows = [
        [
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
        for f in found
    ]
    return Table(
        [
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
        f"{found[0].lanes} neighbouring pixels that go on until the last is done.",
        list(range(3, 11)),
    )


def _answer(bench: Bench, found: list[Factors], precision: str) -> dict[str, Any] | None:
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


def _study(bench: Bench) -> dict[str, Any]:
    found = factors(bench)
    views: dict[str, dict[str, Factors]] = {}
    for f in found:
        if f.precision == "double":
            views.setdefault(f.view, {})[f.fractal] = f
    pairs = [(of["mandelbox"], of["mandelbulb"]) for of in views.values() if set(FRACTALS) <= set(of)]
    return {
        "answers": [a for p in ("double", "float") if (a := _answer(bench, found, p))],
        "figure": comparison(pairs),
        "table": _table(found) if found else None,
        "name": bench.name,
    }


def section(material: Material) -> dict[str, Any]:
    return {
        "studies": [_study(bench) for bench in material.results.study("box-vs-bulb")],
        "missing": Missing("The answer", "bin/bench --study box-vs-bulb --json report/results/box-vs-bulb.json"),
    }
