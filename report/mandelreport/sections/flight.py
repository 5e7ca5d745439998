# SPDX-License-Identifier: Apache-2.0
"""Flights: paths over time, audits, studies, and the choice of the frames."""

from typing import Any

from ..blocks import Missing, Output, Table
from ..figures import flight as figures
from ..text import plain
from . import Material


def _audit_table(audit: dict[str, Any]) -> Table:
    rows = []
    for row in audit["rows"]:
        unit = f" {row['unit']}" if row["unit"] else ""
        kept = "kept" if row["kept"] else "BROKEN" if row["promise"] else "missed"
        rows.append(
            [
                "!" if row["promise"] else "",
                row["name"],
                plain(row["value"]) + unit,
                ("≤ " if row["at_most"] else "≥ ") + plain(row["bar"]) + unit,
                kept,
                row["worst"],
            ]
        )
    return Table(
        ["", "item", "value", "threshold", "", "worst"],
        rows,
        f"Audit of the {audit['fractal']}'s flight, seed {audit['seed']}, {audit['frames']:,} frames. Items with ! are promises and "
        "must be kept; the others describe quality.",
        [2, 3],
    )


def section(material: Material) -> dict[str, Any]:
    results = material.results
    # The last flight's map of balls appears in the main part.
    maps = [(figures.ground(m) if m is not results.maps[-1] else None, figures.over_time(m), m) for m in results.maps]
    command = "bin/flythrough plan path.json --fractal bulb --map results/map_bulb.json"
    return {
        "maps": maps,
        "no_maps": Missing("The map, the path and its measurements", command),
        "audits": [_audit_table(audit) for audit in results.audits]
        or [Missing("The audit", "bin/flythrough audit path.json --json results/flight_bulb.json")],
        "studies": [Output(study) for study in results.flight_studies]
        or [Missing("The study of seeds", "make flight-study")],
    }
