# SPDX-License-Identifier: Apache-2.0
"""Pennycook's metric of performance portability: a cascade over the platforms, best first."""

from typing import Any

from ..backends import Backends
from ..blocks import Figure
from ..text import digits
from . import style


def cascade(entries: list[dict[str, Any]], backends: Backends) -> Figure | None:
    """Shows a panel for each fractal and mode, with a line for each backend and precision. The line's value at n is the
    metric over the n platforms on which the efficiency is highest. Dashes show the efficiency on each platform."""
    if not entries:
        return None
    fractals = list(dict.fromkeys(e["fractal"] for e in entries))
    modes = list(dict.fromkeys(e["mode"] for e in entries))
    platforms = max(len(e["cascade"]) for e in entries)
    figure, axes = style.panels(len(modes), len(fractals), 8, 2.5 * len(modes), sharex=True, sharey=True)
    said = []
    for i, mode in enumerate(modes):
        for j, fractal in enumerate(fractals):
            axis = axes[i][j]
            here = [e for e in entries if e["fractal"] == fractal and e["mode"] == mode]
            for entry in here:
                look = style.line(backends.number_of(entry["application"]))
                x = [k + 1 + (0.04 if entry["precision"] == "float" else -0.04) for k in range(len(entry["cascade"]))]
                fill = "full" if entry["precision"] == "double" else "none"
                name = f"{entry['application']} {entry['precision']}"
                axis.plot(x, [step["portability"] for step in entry["cascade"]], fillstyle=fill, label=name, **look)
                axis.plot(
                    x, [step["efficiency"] for step in entry["cascade"]], marker="_", linestyle="", color=look["color"]
                )
                said.append(f"{fractal} {mode} {name}: {digits(entry['by_application_efficiency'])}")
            axis.set(title=f"{fractal}, {mode}", ylim=(0, 1.05), xlim=(0.5, platforms + 0.5))
            axis.set_xticks(range(1, platforms + 1))
            if j == 0:
                axis.set_ylabel("efficiency")
            if i == len(modes) - 1:
                axis.set_xlabel("platforms, best first")
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8)
    return style.block(
        figure,
        "Cascade of Pennycook's metric by application efficiency. " + "; ".join(said) + ".",
        "Cascade: the metric over the first 1, 2, ... platforms in order of decreasing efficiency (marks and lines), and the "
        "efficiency on each platform (dashes). Filled marks: double; open marks: float.",
    )
