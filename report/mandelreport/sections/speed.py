# SPDX-License-Identifier: Apache-2.0
"""Who is fastest: the primary study's backends as columns, beside both baselines."""

from __future__ import annotations

import dataclasses
from typing import Any

from markupsafe import Markup

from ..answers import named
from ..bench import Bench
from ..blocks import Block, Figure, Missing, Table
from ..figures import timings
from ..text import join, where
from ..trace import Place
from . import Material
from .tables import quotient_cell, time_cell


def _see(figure: Figure | None, text: str) -> Figure | None:
    return figure and dataclasses.replace(figure, see=text)


def _table(material: Material, bench: Bench) -> Table:
    host, backends = material.backends.host, material.backends
    rows = [row for row in bench.rows if row.timed and row.backend != backends.reference]
    names = backends.order(where(row) for row in rows)
    kinds = list(dict.fromkeys((row.fractal, row.precision, row.mode) for row in rows))
    by = {(row.fractal, row.precision, row.mode, where(row)): row for row in rows}
    cells = []
    for kind in kinds:
        own = by.get((*kind, host))
        ups = [quotient_cell(own, key) if own else "–" for key in ("speed_up", "over_scalar")]
        if ups[1] == "–":
            ups[1] = _elsewhere(material, *kind)
        cells.append([*kind, *(time_cell(by.get((*kind, name))) for name in names), *ups])
    return Table(
        ["fractal", "number", "mode", *(f"{name}, ms" for name in names), f"{host} over serial", f"{host} over scalar"],
        cells,
        f"Kernel time with its 95 % interval ({bench.name}), and the host's wall-time speed-up over the serial reference in double and "
        "exact mode and over the same text in scalar C++ on the same threads (* from another file, which Appendix B names).",
        list(range(3, 5 + len(names))),
    )


def _elsewhere(material: Material, fractal: str, precision: str, mode: str) -> str:
    found = material.answers.speed_up("over_scalar", fractal, precision, mode)
    return quotient_cell(found[1], "over_scalar").replace(" [", " * [") if found else "–"


def fastest(bench: Bench) -> str:
    """The backends that are fastest in some fractal, precision and mode."""
    kinds = dict.fromkeys((row.fractal, row.precision, row.mode) for row in bench.timed())
    of_kind = [[row for row in bench.timed() if (row.fractal, row.precision, row.mode) == kind] for kind in kinds]
    best = dict.fromkeys(where(min(rows, key=lambda row: row.kernel.median)) for rows in of_kind)
    return join(list(best))


def _peak_see(material: Material, bench: Bench) -> str:
    best = max((r for r in bench.rows if r.timed and r.figures["share_of_peak"]), key=lambda r: r.figures["share_of_peak"], default=None)
    if best is None:
        return ""
    share = material.answers.trace.one(bench.name, f"rows:name={best.name}:figures.share_of_peak", "plain", 100)
    return Markup(
        "the highest bar is {} % ({}, {}, {}, {}). The rest is work that is no multiply-add and lanes that wait; Appendix B counts the loops' instructions."
    ).format(share, where(best), best.fractal, best.precision, best.mode)


def _bars_see(material: Material, bench: Bench) -> str:
    path = f"rows:backend={material.backends.host}&point=&figures!=null:figures.kernel_seconds.median"
    least, most = (material.answers.trace.number(Place((bench.name,), path, rule), scale=1e3) for rule in ("least", "most"))
    return Markup(
        "{} takes {} to {} ms. {} has the lowest bars. Where intervals of two bars overlap, their ratio may still be sure, as it is taken round by round."
    ).format(material.backends.host, least, most, fastest(bench))


def _machines_see(machines: list[Bench]) -> str:
    if not machines:
        return ""
    each = [Markup("{}: {} is the fastest").format(named(bench.machine), fastest(bench)) for bench in machines]
    return Markup("; ").join(each) + Markup("; {} pixels on each.").format(named(machines[0].size))


def section(material: Material) -> dict[str, Any]:
    bench = material.answers.primary
    if bench is None:
        return {"missing": Missing("The timings", "make bench")}
    backends = material.backends
    machines = material.results.machines()
    blocks: list[Block | None] = [
        _table(material, bench),
        _see(timings.kernel_bars(bench, backends), _bars_see(material, bench)),
        _see(timings.share_of_peak(bench, backends), _peak_see(material, bench)),
        _see(timings.machines(machines), _machines_see(machines)),
    ]
    return {"blocks": [block for block in blocks if block], "warnings": bench.data["warnings"], "name": bench.name}
