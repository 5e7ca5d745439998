# SPDX-License-Identifier: Apache-2.0
"""Charts by matplotlib, with colours of Okabe and Ito, each with a marker and a dash for black and white."""

import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Plot

from .bench import Times
from .blocks import Figure, data_uri
from .text import digits, plain

# Okabe and Ito, "Color Universal Design", 2008.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
COLOURS = [BLUE, ORANGE, GREEN, RED, SKY, PURPLE, YELLOW, BLACK]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
MARKS = {"exact": "o", "fast": "s"}  # of charts with both modes
DASHES = ["-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)), (0, (8, 2)), (0, (3, 3))]

SETTINGS: Any = {
    "svg.hashsalt": "mandelmarch",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "figure.constrained_layout.use": True,
    "axes.titlesize": 10,
    "errorbar.capsize": 2.5,
    "lines.markersize": 5,
}


def line(number: int) -> dict[str, Any]:
    """Returns colour, marker and dash of series `number`. Series from the ninth on repeat the colours with other markers
    and dashes."""
    turn = (number + number // 8) % 8
    return {"color": COLOURS[number % 8], "marker": MARKERS[turn], "linestyle": DASHES[turn]}


def panels(rows: int, columns: int, width: float, height: float, **options: Any) -> tuple[Plot, list[list[Axes]]]:
    """`width`, `height`: inches of the whole figure."""
    plt.rcParams.update(matplotlib.rcParamsDefault)
    plt.rcParams.update(SETTINGS)
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), squeeze=False, **options)
    return figure, [list(row) for row in axes]


def legend(figure: Plot, axis: Axes) -> None:
    handles, labels = axis.get_legend_handles_labels()
    columns = max(1, min(5, 100 // max(map(len, labels))))
    figure.legend(handles, labels, loc="outside lower center", ncols=columns)


@dataclass(frozen=True)
class Dot:
    """A median with its interval, in the panel and on the line of these names. `series`: the number of its colour and
    marker; `part`: its place on the line, from 0; `said`: what it is, for readers who cannot see the chart."""

    panel: str
    name: str
    times: Times
    series: int
    part: int
    said: str
    label: str = ""  # in the legend; empty: none
    filled: bool = True
    marker: str = ""  # empty: that of the series


def dots(found: Sequence[Dot], names: Sequence[str], x_title: str, columns: int = 2, width: float = 8, base: int = 0, even: bool = True) -> Plot:
    """Returns a chart of dots. `names`: the lines, from the top; `base`: that of a logarithmic axis, 0 for a linear one;
    `even`: with a line at 1."""
    titles = list(dict.fromkeys(dot.panel for dot in found))
    columns = min(columns, len(titles))
    rows = math.ceil(len(titles) / columns)
    parts = 1 + max(dot.part for dot in found)
    figure, axes = panels(rows, columns, width, 1 + (0.3 + 0.2 * len(names)) * rows, sharex=True, sharey=True)
    flat = [axis for of_row in axes for axis in of_row]
    labels = set()
    for dot in found:
        look = line(dot.series) | {"linestyle": "", "fillstyle": "full" if dot.filled else "none"} | ({"marker": dot.marker} if dot.marker else {})
        label = dot.label if (dot.panel, dot.label) not in labels else ""
        labels.add((dot.panel, dot.label))
        at = names.index(dot.name) + 0.6 * ((dot.part + 0.5) / parts - 0.5)
        axis = flat[titles.index(dot.panel)]
        axis.errorbar(dot.times.median, at, xerr=[[error] for error in dot.times.errors()], label=label, **look)
    for axis, title in zip(flat, titles):
        axis.set_title(title)
        axis.set_yticks(range(len(names)), names, fontsize=8)
        axis.grid(axis="y", visible=False)
        if even:
            axis.axvline(1, color="black", linewidth=0.8)
        if base:
            axis.set_xscale("log", base=base)
            axis.xaxis.set_major_formatter(lambda x, _: plain(x))
        else:
            axis.set_xlim(left=0)
    flat[0].invert_yaxis()
    for axis in axes[-1]:
        axis.set_xlabel(x_title)
    if any(dot.label for dot in found):
        legend(figure, flat[0])
    return figure


def values_of(found: Sequence[Dot]) -> str:
    return "; ".join(f"{dot.said}: {digits(dot.times.median)}" for dot in found) + "."


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def block(figure: Plot, alt: str, caption: str, wide: bool = True) -> Figure:
    """Returns the figure as SVG. The same data gives the same bytes."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", dpi=150, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    # Rounds path coordinates to hundredths of a point, which is finer than a printer's resolution.
    short = re.sub(r'(?<= d=")[^"]*', lambda path: re.sub(r"-?\d+\.\d{3,}", _rounded, path[0]), buffer.getvalue())
    return Figure(data_uri("image/svg+xml", short.encode()), alt, caption, wide)
