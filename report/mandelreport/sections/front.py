# SPDX-License-Identifier: Apache-2.0
"""The front page: the findings, each answer with its number and interval."""

from typing import Any

from .. import charts
from ..bench import Backends, Bench, Row
from ..blocks import Figure, Missing, Table
from ..text import digits, join
from . import Material

# Rungs of the ladder from the serial reference to the fastest picture.
RUNGS = {
    "reference": "serial reference",
    "text": "kernel as scalar C++",
    "float": "float for double",
    "simd": "explicit SIMD",
    "operations": "cheaper operations",
    "estimates": "fewer DE evaluations",
    "threads": "all threads",
}

KINDS = [(precision, mode) for mode in charts.MARKS for precision in ("double", "float")]

def _times(bench: Bench, backends: Backends) -> Figure:
    """Shows the times, with the reference last, in a figure that is narrow enough for a phone or beside text."""
    rows = [row for row in bench.all_rows if row.timed]
    dots = [
        charts.Dot(
            row.fractal,
            row.label,
            row.kernel.scaled(1e3),
            backends.number_of(row.backend),
            KINDS.index((row.precision, row.mode)),
            f"{row.fractal}, {row.label}, {row.precision}, {row.mode}",
            filled=row.precision == "double",
            marker=charts.MARKS[row.mode],
        )
        for row in rows
    ]
    title = "kernel time per picture [ms], logarithmic"
    figure = charts.dots(dots, backends.order((row.label for row in rows)), title, columns=1, width=4, base=10, even=False)
    return charts.block(
        figure,
        "Kernel times in ms as points with intervals. " + charts.values_of(dots),
        f"Kernel time of one picture of {bench.size} pixels, median and 95 % interval; {bench.machine}, {bench.name}. Filled marks: double; "
        "open marks: float; squares: fast mode.",
        wide=False,
    )

def _gain(question: str, row: Row | None) -> list[str]:
    """Returns the cells of a rung's gain and of its interval."""
    ratio = row.compared(question) if row else None
    if ratio is None:
        return ["", ""]
    gain = ratio.inverse()
    return [digits(gain.median), f"[{', '.join(map(digits, gain.interval))}]" if gain.interval else ""]

def _ladder(bench: Bench) -> Table:
    """Returns a table with a line for each rung and one for all rungs together, and three columns for each fractal."""
    fractals, values = bench.values("fractal"), bench.values("sweep_value")
    rows = {(row.fractal, row.sweep_value): row for row in bench.timed()}
    lines = []
    for value in values:
        name = value.partition("=")[2]
        line = [RUNGS.get(name, name)]
        for row in (rows.get((fractal, value)) for fractal in fractals):
            line += [f"{1e3 * row.kernel.median:,.1f}" if row else "–", *_gain("to_previous_value", row)]
        lines.append(line)
    last = [rows.get((fractal, values[-1])) for fractal in fractals]
    lines.append(["all together", *(cell for row in last for cell in ("", *_gain("to_first_value", row)))])
    headers = ["rung", *(header for fractal in fractals for header in (f"{fractal}, ms", "gain", "interval"))]
    caption = f"Kernel time of {bench.size} pixels, and gain over the rung before ({bench.machine}, {bench.name})."
    return Table(headers, lines, caption, list(range(1, len(headers))))

def section(material: Material) -> dict[str, Any]:
    answers = material.answers
    cost = answers.cost()
    timed = answers.primary.values("backend") if answers.primary else []
    return {
        "models": join([material.backends.title(name) for name in timed if name != material.backends.reference] or ["several models"]),
        "same": answers.same(),
        "cost": cost and cost | {"backends": join(cost["backends"])},
        "gpu_measured": material.results.gpu_measured(),
        "fastest": answers.fastest(),
        "speed_ups": answers.speed_ups(),
        "ladder": [_ladder(bench) for bench in material.results.study("ladder")],
        "no_ladder": Missing("The ladder", "bin/bench --study ladder --json results/ladder.json"),
        "fractals": answers.box_or_bulb(),
        "float": answers.float_or_double(),
        "gpu": answers.gpu(),
        "film": answers.film(),
        "figure": _times(answers.primary, material.backends) if answers.primary else None,
        "bench": Missing("This answer", "make bench"),
        "no_gpu": Missing("This answer", "make gpu-results"),
        "no_film": Missing("This answer", "bin/flythrough film --output video.mp4 --summary results/film.json"),
        "file": answers.primary.name if answers.primary else "",
        "runs": answers.primary.data["runs"] if answers.primary else 0,
        "machine": answers.primary.machine if answers.primary else "",
    }
