# SPDX-License-Identifier: Apache-2.0
"""The ladder from the serial reference to the fastest picture: each rung is a change, and shows the change's gain."""

from __future__ import annotations

from ..bench import Bench
from ..blocks import Figure, Table
from ..text import digits, plain
from . import style

RUNGS = {
    "reference": "serial reference",
    "text": "kernel as scalar C++",
    "float": "float for double",
    "simd": "explicit SIMD",
    "operations": "cheaper operations",
    "estimates": "fewer DE evaluations",
    "threads": "all threads",
}


def ladder(bench: Bench) -> Figure:
    """Shows a panel for each fractal, with a bar for each rung. A bar begins at the product of the gains of all rungs
    before it. It ends at the product that includes its own gain."""
    fractals = bench.values("fractal")
    figure, axes = style.panels(len(fractals), 1, 4, 2.2 * len(fractals), sharex=True)
    said = []
    for number, ((axis,), fractal) in enumerate(zip(axes, fractals)):
        rows = bench.timed(fractal=fractal)
        before = 1.0
        for at, row in enumerate(rows):
            gain = bench.compared("to_previous_value", row)
            if gain is None:
                continue
            gain = gain.inverse()
            errors = [[before * error] for error in gain.errors()]
            axis.barh(at, before * (gain.median - 1), left=before, xerr=errors, **style.look(number))
            axis.text(1.02, at, digits(gain.median), transform=axis.get_yaxis_transform(), va="center", fontsize=7)
            said.append(f"{fractal}, {RUNGS.get(row.value, row.value)}: {digits(gain.median)}")
            before *= gain.median
        axis.set_yticks(range(len(rows)), [RUNGS.get(row.value, row.value) for row in rows])
        axis.invert_yaxis()
        axis.set(xscale="log", title=fractal)
        axis.xaxis.set_major_formatter(lambda x, _: plain(x))
        axis.grid(axis="y", visible=False)
    axes[-1][0].set_xlabel("times as fast as the reference, logarithmic")
    width, height = bench.rows[0].size
    return style.block(
        figure,
        "Bars, each from the end of the one before: gain of each rung. " + "; ".join(said) + ".",
        f"Gain of each rung over the one before (at the right), with its 95 % interval; {width} x {height} pixels, {bench.machine}, {bench.name}.",
        wide=False,
    )


def ladder_table(bench: Bench, fractal: str) -> Table:
    lines = []
    rows = bench.timed(fractal=fractal)
    measured = [(row, RUNGS.get(row.value, row.value), f"{1e3 * row.kernel.median:,.1f}", "to_previous_value") for row in rows]
    for row, name, time, question in [*measured, (rows[-1], "all together", "", "to_first_value")]:
        ratio = bench.compared(question, row)
        gain = ratio.inverse() if ratio else None
        interval = f"[{', '.join(map(digits, gain.interval))}]" if gain and gain.interval else ""
        lines.append([name, time, digits(gain.median) if gain else "", interval])
    return Table(["rung", "ms", "gain", "interval"], lines, f"{fractal}: kernel time, and gain over the rung before.", [1, 2, 3])
