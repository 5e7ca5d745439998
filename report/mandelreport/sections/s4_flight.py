# SPDX-License-Identifier: Apache-2.0
"""Section 4: how the frames are chosen."""

from __future__ import annotations

import io
from typing import Any

from PIL import Image

from ..blocks import Figure, Missing, Table, data_uri
from ..docs import chapter
from ..figures import flight as figures
from ..flight import Audit
from ..text import plain
from . import Material

SHEET_WIDTH = 1600  # pixels
SHEET_QUALITY = 80


def _audit_table(audit: Audit) -> Table:
    rows = []
    for row in audit.data["rows"]:
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
    data = audit.data
    return Table(
        ["", "row", "value", "bar", "", "worst"],
        rows,
        f"Audit of the {data['fractal']}'s flight, seed {data['seed']}, {data['frames']:,} frames. ! is a promise, the "
        "others are quality.",
        [2, 3],
    )


def _sheet(path: Any) -> Figure:
    """A contact sheet, made small enough for the page."""
    with Image.open(path) as image:
        small = image.convert("RGB")
        if small.width > SHEET_WIDTH:
            small = small.resize((SHEET_WIDTH, round(small.height * SHEET_WIDTH / small.width)), Image.Resampling.LANCZOS)
        buffer = io.BytesIO()
        small.save(buffer, format="JPEG", quality=SHEET_QUALITY, optimize=True)
    return Figure(
        data_uri("image/jpeg", buffer.getvalue()),
        f"Contact sheet of the film ({path.stem}): small frames in their order, row by row, from outside the fractal to "
        "its holes.",
        f"The film in small: {path.stem}.",
    )


def section(material: Material) -> dict[str, Any]:
    results = material.results
    maps = [(figures.ground(flight), figures.over_time(flight), flight) for flight in results.maps]
    command = "bin/flythrough plan path.json --fractal bulb --map report/results/map_bulb.json"
    return {
        "seed_to_path": chapter("docs/flight.md", "From the seed to the path"),
        "audit_text": chapter("docs/flight.md", "The audit"),
        "maps": maps,
        "no_maps": Missing("The map, the path and what was measured on it", command),
        "audits": [_audit_table(audit) for audit in results.audits],
        "no_audits": Missing("The audit", "bin/flythrough audit path.json --json report/results/flight_bulb.json"),
        "studies": results.flight_studies,
        "no_studies": Missing("The study of many seeds, of anti-aliasing and of segments", "make flight-study"),
        "sheets": [_sheet(path) for path in results.contact_sheets],
        "no_sheets": Missing("The contact sheet", "make contact-sheet"),
    }
