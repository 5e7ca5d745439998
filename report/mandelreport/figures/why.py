# SPDX-License-Identifier: Apache-2.0
"""Factors that explain why one fractal takes longer than the other."""

import math

from dataclasses import dataclass

from ..bench import Bench
from ..blocks import Figure
from ..text import digits, plain
from . import style

NAMES = ("DE evaluations per pixel", "iterations per DE evaluation", "operations per iteration", "idle lanes (sample)", "all four", "measured time")
TICKS = (0.0625, 0.125, 0.25, 0.5, 1, 2, 4, 8, 16, 32)


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
    """Shows each factor of the Mandelbox divided by the Mandelbulb's, with a mark for each scene."""
    if not pairs:
        return None
    figure, [[axis]] = style.panels(1, 1, 8, 2.8)
    said = []
    for number, (box, bulb) in enumerate(pairs):
        parts = [
            box.calls / bulb.calls,
            box.iterations / bulb.iterations,
            box.operations / bulb.operations,
            bulb.active / box.active,
        ]
        values = [*parts, math.prod(parts), *([box.kernel / bulb.kernel] if box.kernel and bulb.kernel else [])]
        at = [k + 0.13 * (number - (len(pairs) - 1) / 2) for k in range(len(values))]
        axis.plot(values, at, label=box.view, **style.line(number) | {"linestyle": ""})
        said += [f"{box.view}, {name}: {digits(value)}" for name, value in zip(NAMES, values)]
    axis.set_xscale("log", base=2)
    ticks = [t for t in TICKS if axis.get_xlim()[0] <= t <= axis.get_xlim()[1]]
    axis.set_xticks(ticks, [plain(t) for t in ticks])
    axis.axvline(1, color="black", linewidth=0.8)
    axis.set_yticks(range(len(NAMES)), NAMES, fontsize=8)
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.set_xlabel("Mandelbox / Mandelbulb, logarithmic")
    figure.legend(loc="outside lower center", fontsize=8, ncols=len(pairs))
    return style.block(
        figure,
        "Points on a logarithmic scale, Mandelbox over Mandelbulb. " + "; ".join(said) + ".",
        "Mandelbox over Mandelbulb, factor by factor and scene by scene (in double; above 1: the Mandelbox does more). Idle lanes: the "
        "Mandelbulb's fraction of active lanes over the Mandelbox's. DE evaluations and iterations are counted over all pixels, operations and "
        f"lanes in a sample of {pairs[0][0].sample:,} pixels of each picture. The fifth line is the product of the first four.",
    )
