# SPDX-License-Identifier: Apache-2.0
"""Studies in which one setting varies, and parallelisation: the directives, the threads, and the gain from each
technique."""

import math
from typing import Any

from .. import charts
from ..bench import Bench, Row, Times
from ..blocks import Block, Figure, Missing, Table
from ..text import digits, plain
from . import Material

# Arguments of _sweep(): study, title of x, quantity on y, caption.
SWEEPS = [
    (
        "resolution",
        "picture [pixels]",
        "rate",
        "Pixels per second by picture size. If a line is flat, twice the pixels take twice the time. Wide pictures have more "
        "background.",
    ),
    (
        "frames",
        "pictures from one fresh renderer",
        "ms",
        "Wall time per picture, including context and build: the cost of opening a device, and after how many pictures it is negligible.",
    ),
    ("simd-widths", "pixels at once on a core", "ms", "Kernel time by the number of pixels that a core computes at once."),
    (
        "tiles",
        "tiles that a thread takes at once",
        "ms",
        "Kernel time by the number of 16 x 16 tiles that a thread takes at once.",
    ),
    ("iterations", "limit of iterations", "ms", "Kernel time by the distance estimator's limit of iterations."),
    ("detail", "detail level D", "ms", "Kernel time by detail level: a ray hits the surface if DE < 10^D t."),
]
THREADS = ("threads", "threads", "speed-up", "Speed-up over one thread, with its interval. The last point uses twice the processor's threads.")
Y_TITLES = {"rate": "Mpixel/s", "speed-up": "speed-up", "ms": "time [ms]"}
RANKS = ["MPI", "each rank requests the next segment of frames, renders it on its own device and encodes it; ranks exchange only segment numbers"]


def _series(bench: Bench) -> dict[tuple[str, str], list[Row]]:
    """Returns the timed rows of each line of the figure, by fractal and by the line's name: the backend and, if the
    study has several, the precision and the mode."""
    precisions, modes = bench.values("precision"), bench.values("mode")
    lines: dict[tuple[str, str], list[Row]] = {}
    for row in bench.rows:
        if not row.timed:
            continue
        more = [text for text, texts in ((row.precision, precisions), (row.mode, modes)) if len(texts) > 1]
        lines.setdefault((row.fractal, ", ".join([row.where, *more])), []).append(row)
    return lines


def _x(bench: Bench, row: Row) -> float:
    return math.prod(row.size) / 1e6 if bench.study == "resolution" else float(row.value)


def _label(bench: Bench, row: Row) -> str:
    return "{} x\n{}".format(*row.size) if bench.study == "resolution" else plain(float(row.value))


def _value(bench: Bench, row: Row, y: str) -> Times:
    """`y`: ms, rate (Mpixel/s), or the speed-up over the first value of the setting."""
    if y == "speed-up":
        compared = row.compared("to_first_value")
        return compared.inverse() if compared else Times(1, None)
    times = row.wall if bench.study == "frames" else row.kernel
    return times.scaled(1e3) if y == "ms" else times.inverse().scaled(row.figures["pixels_per_second"] / 1e6 * times.median)


def figure_of(bench: Bench, x_title: str, y: str, caption: str) -> Figure | None:
    """Shows lines over the sweep's setting, in a panel for each fractal."""
    lines = _series(bench)
    if not lines:
        return None
    fractals = list(dict.fromkeys(fractal for fractal, _ in lines))
    figure, axes = charts.panels(1, len(fractals), 8 if len(fractals) > 1 else 5.5, 3.2)
    said = []
    for axis, fractal in zip(axes[0], fractals):
        of_fractal = [(name, rows) for (of, name), rows in lines.items() if of == fractal]
        for number, (name, rows) in enumerate(of_fractal):
            points = sorted(((_x(bench, row), _value(bench, row, y)) for row in rows), key=lambda point: point[0])
            errors = list(zip(*(value.errors() for _, value in points)))
            axis.errorbar([x for x, _ in points], [value.median for _, value in points], yerr=errors, label=name, **charts.line(number))
            said.append(f"{fractal}, {name}: " + ", ".join(f"{plain(x)}: {digits(value.median)}" for x, value in points))
        labels = dict(sorted({_x(bench, row): _label(bench, row) for _, rows in of_fractal for row in rows}.items()))
        xs = list(labels)
        if bench.study == "threads":
            axis.plot(xs, [x / xs[0] for x in xs], color="#777777", linewidth=0.8, linestyle=":", label="ideal")
        axis.set_xscale("log" if min(xs) > 0 else "linear")  # linear for detail levels, which are negative
        axis.set_xticks(xs, list(labels.values()), minor=False, fontsize=7)
        axis.minorticks_off()
        axis.set_ylim(bottom=0)
        axis.set(xlabel=x_title, ylabel=Y_TITLES[y], title=fractal)
    charts.legend(figure, axes[0][0])
    return charts.block(figure, f"Lines: {Y_TITLES[y]} over {x_title}. " + "; ".join(said) + ".", caption)


def _ablation(bench: Bench) -> Figure | None:
    """Shows the gain from each technique: the time without this technique divided by the time with all techniques."""
    dots = []
    names = list(dict.fromkeys(name for _, name in _series(bench)))
    for (fractal, name), rows in _series(bench).items():
        part = names.index(name)
        for row in rows:
            if row.value != "none" and (found := row.compared("to_first_value")):
                dots.append(charts.Dot(fractal, row.value, found, part, part, f"{fractal}, {name}, without {row.value}", name))
    if not dots:
        return None
    values = list(dict.fromkeys(dot.name for dot in dots))
    return charts.block(
        charts.dots(dots, values, "time without the technique / time with all"),
        "Points with intervals: time without a technique over the time with all techniques. " + charts.values_of(dots),
        "Ablation: kernel time without a technique as a multiple of the time with all techniques, taken round by round, with its "
        "95 % interval. 1: the technique gains nothing. Without refinement the picture differs.",
    )


def _sweep(material: Material, study: str, x_title: str, y: str, caption: str) -> list[Block]:
    """Returns a figure for each result of the study or, if there is no result, a note with the command that makes
    one."""
    blocks: list[Block] = []
    for bench in material.results.study(study):
        about = f"{caption} {' and '.join(bench.values('mode')).capitalize()} mode; {bench.machine}."
        if figure := figure_of(bench, x_title, y, about):
            blocks.append(figure)
    return blocks or [Missing(f"The study {study}", f"bin/bench --study {study} --json results/{study}.json")]


def sweeps(material: Material) -> dict[str, Any]:
    return {"sweeps": [(entry[0], _sweep(material, *entry)) for entry in SWEEPS]}


def parallel(material: Material) -> dict[str, Any]:
    backends, studies = material.backends, material.results.study("threads")
    lines = [[name, backends.facts[name]["distribution"]] for name in backends.names if name in backends.facts]
    # The sweep of threads has no figure if no machine has more than two cores.
    few = studies and all(bench.environment["cpu"]["cores_usable"] <= 2 for bench in studies)
    ablations = [figure for bench in material.results.study("ablation") if (figure := _ablation(bench))]
    return {
        "distribution": Table(["backend", "distribution of the work"], [*lines, RANKS], "Distribution of pixels and frames."),
        "threads": [] if few else _sweep(material, *THREADS),
        "ablation": ablations or [Missing("The ablation", "bin/bench --study ablation --json results/ablation.json")],
    }
