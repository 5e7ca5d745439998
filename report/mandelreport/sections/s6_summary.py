# SPDX-License-Identifier: Apache-2.0
"""Section 6: the summary that the assignment asks for."""

from __future__ import annotations

from typing import Any

from ..blocks import Missing, Table
from ..flight import Film
from ..text import digits
from . import Material


def _table(film: Film) -> Table:
    rows = [
        ["GPU(s) or CPU used", film.device],
        ["number of frames", f"{film.frames:,}"],
        ["average seconds per frame", digits(film.per_frame) if film.per_frame else "none was rendered in this run"],
        ["frames rendered in this run, seconds", f"{film.rendered:,} in {digits(film.seconds)} s"],
        ["processes", str(film.processes)],
    ]
    if film.details:
        rows.append(["frames", film.details])
    return Table(["", film.fractal], rows, f"The film, from {film.name}. Drawing, filtering and encoding are in the time.")


def section(material: Material) -> dict[str, Any]:
    command = "bin/flythrough film --output video.mp4 --summary report/results/film.json"
    return {"films": [_table(film) for film in material.results.films], "missing": Missing("The film's summary", command)}
