# SPDX-License-Identifier: Apache-2.0
"""The fastest backends of the primary study, compared with both baselines."""

import math
import statistics
from typing import Any

from .. import charts
from ..bench import SCALAR, Backends, Bench, Row, Times
from ..blocks import Figure, Missing, Table
from ..text import digits, ms
from . import Material
from .tables import quotient_cell, time_cell


def _with_scalar(bench: Bench, reference: str) -> list[Row]:
    """Returns all timed rows except the reference's. Unlike Bench.rows, includes the scalar kernel's rows."""
    return [row for row in bench.all_rows if row.timed and row.backend != reference]


def _ranked(rows: list[Row]) -> list[str]:
    """Returns the labels of rows, fastest first. For each fractal, precision and mode, the kernel time is divided by
    that of the fastest row. The order is that of the geometric mean of these ratios."""
    best: dict[tuple[str, ...], float] = {}
    for row in rows:
        best[row.kind] = min(best.get(row.kind, math.inf), row.kernel.median)
    logs: dict[str, list[float]] = {}
    for row in rows:
        logs.setdefault(row.label, []).append(math.log(row.kernel.median / best[row.kind]))
    return sorted(logs, key=lambda name: statistics.mean(logs[name]))


def _table(material: Material, bench: Bench) -> Table:
    """Returns a table with a line for each backend, fastest first. The last lines compare the host with both
    baselines."""
    host, backends = material.backends.host, material.backends
    rows = _with_scalar(bench, backends.reference)
    kinds = list(dict.fromkeys(row.kind for row in rows))
    by = {(*row.kind, row.label): row for row in rows}
    lines = [[name, *(time_cell(by.get((*kind, name))) for kind in kinds)] for name in _ranked(rows)]
    own = [by.get((*kind, host)) for kind in kinds]
    over = [quotient_cell(row, "over_scalar") if row else "–" for row in own]
    work = [row.work_over_scalar(host) if row else None for row in own]
    lines += [
        [f"{host} over serial", *(quotient_cell(row, "speed_up") if row else "–" for row in own)],
        [f"{host} over scalar", *(_elsewhere(material, *kind) if cell == "–" else cell for cell, kind in zip(over, kinds))],
        ["of this, fewer operations", *("–" if share is None else digits(1 / share) for share in work)],
    ]
    return Table(
        ["ms", *(", ".join(kind) for kind in kinds)],
        lines,
        f"Kernel time with its 95 % interval ({bench.name}, {bench.size} pixels), fastest backend first. Last lines: {host}'s wall-time "
        "speed-up over the serial reference in double and exact mode, its speed-up over the scalar kernel on the same threads (*: from "
        "another file, named in Appendix B), and the scalar kernel's counted operations over its own.",
        list(range(1, 1 + len(kinds))),
    )


def _elsewhere(material: Material, fractal: str, precision: str, mode: str) -> str:
    found = material.answers.speed_up("over_scalar", fractal, precision, mode)
    return quotient_cell(found, "over_scalar").replace(" [", " * [") if found else "–"


def over_scalar(bench: Bench, backends: Backends) -> Figure | None:
    """Shows the time of every backend divided by the scalar kernel's time, fastest first, in a panel for each fractal
    and mode."""
    rows = _with_scalar(bench, backends.reference)
    if not any(row.sweep_value == SCALAR for row in rows):
        return None
    modes, fractals = bench.values("mode"), bench.values("fractal")
    dots = [
        charts.Dot(
            f"{row.fractal}, {row.mode}",
            row.label,
            Times(1 if row.sweep_value == SCALAR else row.figures["over_scalar"], row.figures["over_scalar_interval"]).inverse(),
            backends.number_of(row.backend),
            int(row.precision == "float"),
            f"{row.fractal}, {row.precision}, {row.mode}, {row.label}",
            filled=row.precision == "double",
        )
        for row in sorted(rows, key=lambda row: (modes.index(row.mode), fractals.index(row.fractal)))
    ]
    title = "time / time of the scalar kernel, logarithmic"
    return charts.block(
        charts.dots(dots, _ranked(rows), title, columns=len(fractals), base=10),
        "Points with intervals: time over the scalar kernel's. " + charts.values_of(dots),
        "Wall time of one picture over that of the same kernel as plain scalar C++ (the line at 1), with 95 % intervals, fastest backend "
        "first. Filled marks: double; open marks: float. The scalar kernel runs on as many threads as the processor has, backends marked "
        "(1 thread) on one; with two threads, twice the time is then the same speed per thread.",
    )


def _share_of_peak(bench: Bench, backends: Backends) -> Figure | None:
    """Shows counted operations per second as a share of the platform's measured multiply-add peak."""
    rows = [row for row in bench.rows if row.timed and row.figures["share_of_peak"] is not None]
    kinds = list(dict.fromkeys((row.precision, row.mode) for row in rows))
    dots = [
        charts.Dot(
            row.fractal,
            row.label,
            Times(100 * row.figures["share_of_peak"], None),
            backends.number_of(row.backend),
            kinds.index((row.precision, row.mode)),
            f"{row.fractal}, {row.label}, {row.precision}, {row.mode}",
            filled=row.precision == "double",
            marker=charts.MARKS[row.mode],
        )
        for row in rows
    ]
    return None if not dots else charts.block(
        charts.dots(dots, backends.order((row.label for row in rows)), "share of the peak [%]", even=False),
        "Points: the share of the measured peak in percent. " + charts.values_of(dots),
        "Counted operations per second as a share of the platform's measured multiply-add peak, the flat roof of a roofline "
        "plot. The march reads no memory, so the slanted roof (memory bandwidth) does not apply. Filled marks: double; open marks: float; "
        "squares: fast mode.",
    )


def _machines(benches: list[Bench]) -> Figure | None:
    """Shows the speed of each machine's fastest backend, for each fractal, precision and mode."""
    if len(benches) < 2:
        return None
    dots = [
        charts.Dot(
            "",
            ", ".join(row.kind),
            Times(row.figures["pixels_per_second"] / 1e6, None),
            number,
            number,
            f"{bench.machine}: {' '.join(row.kind)}: {row.where}, {ms(row.kernel.median)} ms",
            bench.machine,
        )
        for number, bench in enumerate(benches)
        for row in bench.fastest()
    ]
    figure = charts.dots(dots, list(dict.fromkeys(dot.name for dot in dots)), "Mpixel/s, fastest backend", even=False)
    said = "; ".join(dot.said for dot in dots)
    about = "All machines: pixels per second of the fastest backend."
    return charts.block(figure, f"Points: the fastest backend's rate on each machine. {said}.", about)


def speed(material: Material) -> dict[str, Any]:
    bench = material.answers.primary
    if bench is None:
        return {"missing": Missing("The timings", "make bench")}
    backends = material.backends
    blocks = [
        _table(material, bench),
        over_scalar(bench, backends),
        _share_of_peak(bench, backends),
        _machines(material.results.machines()),
    ]
    return {"blocks": [block for block in blocks if block], "warnings": bench.data["warnings"], "name": bench.name}
