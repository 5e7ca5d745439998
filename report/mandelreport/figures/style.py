# SPDX-License-Identifier: Apache-2.0
"""Common style of all figures: colours of Okabe and Ito, each with a hatch, a marker and a dash for black and white."""

import io
import re
from typing import Any

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Plot

from ..bench import Times
from ..blocks import Figure, data_uri

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
HATCHES = ["", "///", "..", "xx", "\\\\\\", "++", "--", "||"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
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
    "hatch.linewidth": 0.5,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
    "axes.titlesize": 10,
    "errorbar.capsize": 2.5,
    "lines.markersize": 5,
}


def _turn(number: int) -> int:
    """Returns the index of the hatch, marker and dash of a series. Series from the ninth on repeat the colours with
    other hatches, markers and dashes."""
    return (number + number // 8) % 8


def look(number: int) -> dict[str, Any]:
    """Returns colour, hatch and edge of the bars of series `number`."""
    return {"facecolor": COLOURS[number % 8], "hatch": HATCHES[_turn(number)], "edgecolor": "black", "linewidth": 0.6}


def line(number: int) -> dict[str, Any]:
    """Returns colour, marker and dash of the line of series `number`."""
    return {"color": COLOURS[number % 8], "marker": MARKERS[_turn(number)], "linestyle": DASHES[_turn(number)]}


def panels(rows: int, columns: int, width: float, height: float, **options: Any) -> tuple[Plot, list[list[Axes]]]:
    """`width`, `height`: inches of the whole figure."""
    plt.rcParams.update(matplotlib.rcParamsDefault)
    plt.rcParams.update(SETTINGS)
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), squeeze=False, **options)
    return figure, [list(row) for row in axes]


def point(axis: Axes, times: Times, at: float, scale: float = 1, **options: Any) -> None:
    """Plots a median and its interval along x."""
    low, high = times.errors()
    axis.errorbar(scale * times.median, at, xerr=[[scale * low], [scale * high]], **options)


def _rounded(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def block(figure: Plot, alt: str, caption: str, wide: bool = True, name: str = "") -> Figure:
    """Returns the figure as SVG. The same data gives the same bytes."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", dpi=150, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    # Rounds path coordinates to hundredths of a point, which is finer than a printer's resolution. Hatches have
    # thousands of coordinates.
    short = re.sub(r'(?<= d=")[^"]*', lambda path: re.sub(r"-?\d+\.\d{3,}", _rounded, path[0]), buffer.getvalue())
    return Figure(data_uri("image/svg+xml", short.encode()), alt, caption, wide, name=name)
