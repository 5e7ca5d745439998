# SPDX-License-Identifier: Apache-2.0
"""Figures of sweeps: one setting varies along x."""

import math

from ..bench import Bench, Row, Times
from ..blocks import Figure
from ..text import digits, plain, where
from . import style


def _series(bench: Bench) -> dict[tuple[str, str], list[Row]]:
    """Returns the timed rows of each line of the figure, by fractal and by the line's name: the backend and, if the
    study has several, the precision and the mode."""
    precisions, modes = bench.values("precision"), bench.values("mode")
    lines: dict[tuple[str, str], list[Row]] = {}
    for row in bench.rows:
        if not row.timed:
            continue
        more = [text for text, texts in ((row.precision, precisions), (row.mode, modes)) if len(texts) > 1]
        lines.setdefault((row.fractal, ", ".join([where(row), *more])), []).append(row)
    return lines


def _x(bench: Bench, row: Row) -> float:
    return math.prod(row.size) / 1e6 if bench.study == "resolution" else float(row.value)


def _label(bench: Bench, row: Row) -> str:
    return "{} x\n{}".format(*row.size) if bench.study == "resolution" else plain(float(row.value))


def sweep(bench: Bench, x_title: str, y_title: str, caption: str, y: str = "ms", ideal: bool = False) -> Figure | None:
    """Shows lines over the sweep's setting, in a panel for each fractal. `y`: ms, rate (Mpixel/s), or the speed-up over
    the first value of the setting."""
    lines = _series(bench)
    if not lines:
        return None
    fractals = list(dict.fromkeys(fractal for fractal, _ in lines))
    figure, axes = style.panels(1, len(fractals), 8 if len(fractals) > 1 else 5.5, 3.2)
    said = []
    for j, fractal in enumerate(fractals):
        axis = axes[0][j]
        of_fractal = [(name, rows) for (of, name), rows in lines.items() if of == fractal]
        for number, (name, rows) in enumerate(of_fractal):
            points = sorted(((_x(bench, row), row) for row in rows), key=lambda point: point[0])
            times = [(row.wall if bench.study == "frames" else row.kernel) for _, row in points]
            if y == "ms":
                values = [1e3 * t.median for t in times]
                errors = [[1e3 * t.errors()[side] for t in times] for side in (0, 1)]
            elif y == "speed-up":
                gains = [(found.inverse() if (found := bench.compared("to_first_value", row)) else Times(1, None)) for _, row in points]
                values = [gain.median for gain in gains]
                errors = [[gain.errors()[side] for gain in gains] for side in (0, 1)]
            else:
                values = [row.figures["pixels_per_second"] / 1e6 for _, row in points]
                ends = [(t, *(t.interval or (t.median, t.median))) for t in times]
                errors = [
                    [v - v * t.median / high for v, (t, _, high) in zip(values, ends)],
                    [v * t.median / low - v for v, (t, low, _) in zip(values, ends)],
                ]
            errors = [[max(0.0, e) for e in side] for side in errors]
            axis.errorbar([x for x, _ in points], values, yerr=errors, label=name, **style.line(number))
            said.append(f"{fractal}, {name}: " + ", ".join(f"{plain(x)}: {digits(v)}" for (x, _), v in zip(points, values)))
        labels = dict(sorted({_x(bench, row): _label(bench, row) for _, rows in of_fractal for row in rows}.items()))
        xs = list(labels)
        if ideal:
            axis.plot(xs, [x / xs[0] for x in xs], color="#777777", linewidth=0.8, linestyle=":", label="ideal")
        axis.set_xscale("log" if min(xs) > 0 else "linear")  # linear for detail levels, which are negative
        axis.set_xticks(xs, list(labels.values()), minor=False, fontsize=7)
        axis.minorticks_off()
        axis.set_ylim(bottom=0)
        axis.set(xlabel=x_title, ylabel=y_title, title=fractal)
    handles, names = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, names, fontsize=8, loc="outside lower center", ncols=4)
    return style.block(figure, f"Lines: {y_title} over {x_title}. " + "; ".join(said) + ".", caption)


def ablation(bench: Bench) -> Figure | None:
    """Shows the gain from each technique: the time without this technique divided by the time with all techniques."""
    lines = _series(bench)
    fractals = list(dict.fromkeys(fractal for fractal, _ in lines))
    if not fractals:
        return None
    figure, axes = style.panels(1, len(fractals), 8, 3.2, sharey=True)
    said = []
    for j, fractal in enumerate(fractals):
        axis = axes[0][j]
        of_fractal = [(name, rows) for (of, name), rows in lines.items() if of == fractal]
        values = list(dict.fromkeys(row.value for _, rows in of_fractal for row in rows if row.value != "none"))
        width = 0.8 / len(of_fractal)
        for number, (name, rows) in enumerate(of_fractal):
            for row in rows:
                found = bench.compared("to_first_value", row)
                if found is None:
                    continue
                x = values.index(row.value) + (number - (len(of_fractal) - 1) / 2) * width
                axis.bar(
                    x,
                    found.median,
                    width,
                    yerr=[[error] for error in found.errors()],
                    label=name if row.value == values[0] else None,
                    **style.look(number),
                )
                said.append(f"{fractal}, {name}, without {row.value}: {digits(found.median)}")
        axis.axhline(1, color="black", linewidth=0.8)
        axis.set_xticks(range(len(values)), values, rotation=30, ha="right", fontsize=7)
        axis.grid(axis="x", visible=False)
        axis.set(xlabel="disabled technique", title=fractal)
        if j == 0:
            axis.set_ylabel("time / time with all")
    handles, names = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, names, fontsize=8, loc="outside lower center", ncols=4)
    return style.block(
        figure,
        "Bar charts: time without a technique over the time with all techniques. " + "; ".join(said) + ".",
        "Ablation: kernel time without a technique as a multiple of the time with all techniques, taken round by round, with its "
        "95 % interval. 1: the technique gains nothing. Without refinement the picture differs.",
    )
