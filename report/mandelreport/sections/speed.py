# SPDX-License-Identifier: Apache-2.0
"""The fastest backends of the primary study, compared with both baselines."""

from typing import Any

from markupsafe import Markup

from ..answers import named
from ..bench import Bench
from ..blocks import Missing, Table, seen
from ..figures import timings
from ..models import label, ranked, with_scalar
from ..number import Number
from ..text import digits, join, where
from . import Material
from .tables import quotient_cell, time_cell


def _table(material: Material, bench: Bench) -> Table:
    """Returns a table with a line for each backend, fastest first. The last lines compare the host with both
    baselines."""
    host, backends = material.backends.host, material.backends
    rows = with_scalar(bench, backends.reference)
    kinds = list(dict.fromkeys(row.kind for row in rows))
    by = {(*row.kind, label(row)): row for row in rows}
    lines = [[name, *(time_cell(by.get((*kind, name))) for kind in kinds)] for name in ranked(rows)]
    own = [by.get((*kind, host)) for kind in kinds]
    over = [quotient_cell(row, "over_scalar") if row else "–" for row in own]
    work = [bench.work_over_scalar(row, host) if row else None for row in own]
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
        name="times",
    )


def _elsewhere(material: Material, fractal: str, precision: str, mode: str) -> str:
    found = material.answers.speed_up("over_scalar", fractal, precision, mode)
    return quotient_cell(found[1], "over_scalar").replace(" [", " * [") if found else "–"


def _peak_see(bench: Bench) -> str:
    best = max((r for r in bench.rows if r.timed and r.figures["share_of_peak"]), key=lambda r: r.figures["share_of_peak"], default=None)
    if best is None:
        return ""
    share = (100 * Number.of_row(bench, best, "/figures/share_of_peak")).html("plain")
    return Markup(
        "the highest bar is {} % ({}, {}, {}, {}). The rest is operations other than multiply-adds, and idle lanes; Appendix B counts the loops' instructions."
    ).format(share, where(best), best.fractal, best.precision, best.mode)


def _cost_see(material: Material, bench: Bench) -> str:
    cost = material.answers.cost()
    if cost is None:
        return ""
    own = bench.timed(backend=material.backends.host, sweep_value="")
    ends = (pick(own, key=lambda row: row.figures["over_scalar"]) for pick in (min, max))
    least, most = (Number.of_row(bench, row, "/figures/over_scalar").html() for row in ends)
    return Markup(
        "{} stay near the line, at {} to {} times the scalar kernel's speed per thread: the models' own loops cost little. {} is {} to {} times as "
        "fast as the scalar kernel, in fast mode partly because it does fewer operations. Ratios are taken round by round, so two "
        "configurations can differ significantly even if their intervals overlap."
    ).format(join(cost["backends"]), cost["least"], cost["most"], material.backends.host, least, most)


def _machines_see(machines: list[Bench]) -> str:
    if not machines:
        return ""
    each = [Markup("{}: {} is the fastest").format(named(bench.machine), join(list(dict.fromkeys(map(where, bench.fastest()))))) for bench in machines]
    return Markup("; ").join(each) + Markup("; {} pixels on each.").format(named(machines[0].size))


def section(material: Material) -> dict[str, Any]:
    bench = material.answers.primary
    if bench is None:
        return {"missing": Missing("The timings", "make bench")}
    backends = material.backends
    machines = material.results.machines()
    blocks = [
        _table(material, bench),
        seen(timings.over_scalar(bench, backends), _cost_see(material, bench)),
        seen(timings.share_of_peak(bench, backends), _peak_see(bench)),
        seen(timings.machines(machines), _machines_see(machines)),
    ]
    return {"blocks": [block for block in blocks if block], "warnings": bench.data["warnings"], "name": bench.name}
