# SPDX-License-Identifier: Apache-2.0
"""The front page's figure: times of all backends and of both baselines."""

from ..backends import Backends
from ..bench import Bench
from ..blocks import Figure
from ..models import label
from ..text import ms, plain
from . import style

# Fill style and shape of the marker of each precision and mode.
KINDS = {
    ("double", "exact"): ("full", "o"),
    ("float", "exact"): ("none", "o"),
    ("double", "fast"): ("full", "s"),
    ("float", "fast"): ("none", "s"),
}


def times(bench: Bench, backends: Backends) -> Figure:
    """Shows the times, with the reference last, in a figure that is narrow enough for a phone or beside text."""
    rows = [row for row in bench.all_rows if row.timed]
    fractals = list(dict.fromkeys(row.fractal for row in rows))
    names = backends.order(label(row) for row in rows)
    figure, axes = style.panels(len(fractals), 1, 4, 1.0 + 0.2 * len(names) * len(fractals), sharex=True)
    said = []
    for (axis,), fractal in zip(axes, fractals):
        for row in (row for row in rows if row.fractal == fractal):
            name = label(row)
            fill, marker = KINDS[(row.precision, row.mode)]
            at = names.index(name) + 0.15 * (list(KINDS).index((row.precision, row.mode)) - 1.5)
            style.point(
                axis,
                row.kernel,
                at,
                1e3,
                marker=marker,
                fillstyle=fill,
                color=style.COLOURS[backends.number_of(row.backend) % 8],
                linestyle="",
                markersize=4,
            )
            said.append(f"{fractal}, {name}, {row.precision}, {row.mode}: {ms(row.kernel.median)} ms")
        axis.set_yticks(range(len(names)), names, fontsize=8)
        axis.invert_yaxis()
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter(lambda x, _: plain(x))
        axis.grid(axis="y", visible=False)
        axis.set_title(fractal)
    axes[-1][0].set_xlabel("kernel time per picture [ms], logarithmic")
    handles = [
        axes[0][0].plot([], [], marker=marker, fillstyle=fill, color="black", linestyle="", label=f"{precision}, {mode}")[0]
        for (precision, mode), (fill, marker) in KINDS.items()
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=8)
    width, height = rows[0].size
    return style.block(
        figure,
        "Kernel times as points with intervals. " + "; ".join(said) + ".",
        f"Kernel time of one picture of {width} x {height} pixels, median and 95 % interval; "
        f"{bench.machine}, {bench.name}.",
        wide=False,
    )
