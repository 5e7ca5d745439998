# SPDX-License-Identifier: Apache-2.0
"""Factors that explain why one fractal takes longer than the other."""

from __future__ import annotations

import math

from dataclasses import dataclass

from ..bench import Bench
from ..blocks import Figure
from ..text import digits, plain
from . import style


@dataclass(frozen=True)
class Factors:
    """The factors of a picture's operations per pixel: DE evaluations per pixel, iterations per evaluation, operations
    per iteration. DE evaluations and iterations are counted over all pixels. Operations per iteration and active lanes
    are counted in a sample of the pixels."""

    fractal: str
    precision: str
    view: str
    calls: float  # DE evaluations per pixel
    iterations: float  # per DE evaluation
    operations: float  # per iteration
    active: float  # fraction of lanes active in DE iterations
    active_steps: float
    lanes: int
    sample: int  # pixels
    sampled_calls: float  # per pixel of the sample
    kernel: float | None  # seconds per picture
    share_of_peak: float | None

    @property
    def per_pixel(self) -> float:
        return self.calls * self.iterations * self.operations


def factors(bench: Bench, backend: str) -> list[Factors]:
    """Returns the factors of every scene of the study box-vs-bulb that `backend` rendered, in the order of its rows."""
    found = []
    rows = {(row.fractal, row.precision, row.setting["view"]): row for row in bench.rows if row.backend == backend}
    for count in bench.data["counts"]:
        view = count["setting"]["view"]
        row = rows.get((count["fractal"], count["precision"], view))
        if row is None or not row.work["iterations"]:
            continue
        found.append(
            Factors(
                count["fractal"],
                count["precision"],
                view,
                row.work["de_calls"] / math.prod(row.size),
                row.work["iterations"] / row.work["de_calls"],
                row.operations / row.work["iterations"],
                count["lane_use"][0]["together"]["in_iterations"],
                count["lane_use"][0]["together"]["in_steps"],
                count["lane_use"][0]["lanes"],
                count["pixels"],
                count["work"]["de_calls"] / count["pixels"],
                row.kernel.median if row.timed else None,
                row.figures["share_of_peak"] if row.timed else None,
            )
        )
    order = {key: number for number, key in enumerate(rows)}
    return sorted(found, key=lambda f: order.get((f.fractal, f.precision, f.view), 999))


def comparison(pairs: list[tuple[Factors, Factors]]) -> Figure | None:
    """Shows each factor of the Mandelbox divided by the Mandelbulb's, with a bar for each scene."""
    if not pairs:
        return None
    names = [
        "DE evaluations\nper pixel",
        "iterations per\nDE evaluation",
        "operations\nper iteration",
        "idle lanes\n(sample)",
        "all four",
        "measured\ntime",
    ]
    figure, [[axis]] = style.panels(1, 1, 8, 3.3)
    width = 0.8 / len(pairs)
    said = []
    for number, (box, bulb) in enumerate(pairs):
        parts = [
            box.calls / bulb.calls,
            box.iterations / bulb.iterations,
            box.operations / bulb.operations,
            bulb.active / box.active,
        ]
        product = parts[0] * parts[1] * parts[2] * parts[3]
        values = [*parts, product, box.kernel / bulb.kernel if box.kernel and bulb.kernel else None]
        for k, value in enumerate(values):
            if value is None:
                continue
            x = k + (number - (len(pairs) - 1) / 2) * width
            # Bars start at 1. Factors that make the Mandelbox slower point up, the others down.
            axis.bar(x, value - 1, width, bottom=1, label=box.view if k == 0 else None, **style.look(number))
            axis.text(x, max(value, 1) * 1.05, digits(value, 2), ha="center", va="bottom", fontsize=6.5, rotation=90)
            said.append(f"{box.view}, {names[k].replace(chr(10), ' ')}: {digits(value)}")
    axis.set_yscale("log", base=2)
    axis.margins(y=0.15)
    ticks = [t for t in (0.0625, 0.125, 0.25, 0.5, 1, 2, 4, 8, 16, 32) if axis.get_ylim()[0] <= t <= axis.get_ylim()[1]]
    axis.set_yticks(ticks, [plain(t) for t in ticks])
    axis.axhline(1, color="black", linewidth=0.8)
    axis.set_xticks(range(len(names)), names)
    axis.grid(axis="x", visible=False)
    axis.set_ylabel("Mandelbox / Mandelbulb")
    figure.legend(loc="outside lower center", title="scene", fontsize=8, ncols=len(pairs))
    return style.block(
        figure,
        "Bars on a logarithmic scale, Mandelbox over Mandelbulb. " + "; ".join(said) + ".",
        "Mandelbox over Mandelbulb, factor by factor (in double; above 1: the Mandelbox does more). Idle lanes: the Mandelbulb's "
        "fraction of active lanes over the Mandelbox's. DE evaluations and iterations are counted over all pixels, operations and lanes in a "
        f"sample of {pairs[0][0].sample:,} pixels of each picture. The fifth group is the product of the first four.",
    )
