# SPDX-License-Identifier: Apache-2.0
"""The fastest backends of the primary study, compared with both baselines."""

from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from ..figures import timings
from ..models import label, ranked, with_scalar
from ..text import digits
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


def section(material: Material) -> dict[str, Any]:
    bench = material.answers.primary
    if bench is None:
        return {"missing": Missing("The timings", "make bench")}
    backends = material.backends
    blocks = [
        _table(material, bench),
        timings.over_scalar(bench, backends),
        timings.share_of_peak(bench, backends),
        timings.machines(material.results.machines()),
    ]
    return {"blocks": [block for block in blocks if block], "warnings": bench.data["warnings"], "name": bench.name}
