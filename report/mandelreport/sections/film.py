# SPDX-License-Identifier: Apache-2.0
"""Choice of the frames, a frame, and the film's summary that the assignment requires."""

from pathlib import Path
from typing import Any

from PIL import Image

from ..blocks import Figure, Missing, Table, data_uri, seen
from ..figures import flight as figures
from ..flight import Film
from ..pictures import ROOT, encoded
from ..text import digits
from . import Material

GROUND = "the path (red) stays within the free balls (pale) and leads from passage to passage (diamonds)."
SHEET_WIDTH = 1600  # pixels
SHEET_QUALITY = 80


def _table(film: Film) -> Table:
    rows = [
        ["GPU(s) or CPU used", film.device],
        ["number of frames", f"{film.frames:,}"],
        ["average seconds per frame", digits(film.per_frame) if film.per_frame else "no frame was rendered in this run"],
        ["frames rendered in this run, seconds", f"{film.rendered:,} in {digits(film.seconds)} s"],
        ["processes", str(film.processes)],
    ]
    if film.details:
        rows.append(["settings", film.details])
    return Table(["", film.fractal], rows, f"The film, from {film.name}. The time includes rendering, filtering and encoding.")


def _sheet(path: Path) -> Figure:
    """Returns a contact sheet, scaled down for the page."""
    with Image.open(path) as image:
        small = image.convert("RGB")
        if small.width > SHEET_WIDTH:
            small = small.resize((SHEET_WIDTH, round(small.height * SHEET_WIDTH / small.width)), Image.Resampling.LANCZOS)
    return Figure(
        encoded(small, "jpeg", quality=SHEET_QUALITY, optimize=True),
        f"Contact sheet of the film ({path.stem}): small frames in order, row by row, from outside the fractal into its holes.",
        f"Frames of the film: {path.stem}.",
        see="row by row, the camera approaches from outside, enters a hole and continues from hole to hole.",
    )


def _frame() -> Figure:
    """Returns a frame of the film, which tools/gallery renders."""
    return Figure(
        data_uri("image/jpeg", (ROOT / "docs" / "pictures" / "flight.jpg").read_bytes()),
        "A frame of the film: inside the Mandelbulb, between its walls.",
        "Frame 2700 of the Mandelbulb's flight with seed 1, rendered at 1920 x 1080 (make gallery).",
    )


def section(material: Material) -> dict[str, Any]:
    results = material.results
    map_command = "bin/flythrough plan path.json --fractal bulb --map results/map_bulb.json"
    ground = figures.ground(results.maps[-1]) if results.maps else None
    promises = [row for audit in results.audits for row in audit["rows"] if row["promise"]]
    return {
        "frame": _frame(),
        "cost": material.answers.film(),
        "films": [_table(film) for film in results.films]
        or [Missing("The film's summary", "bin/flythrough film --output video.mp4 --summary results/film.json")],
        "map": seen(ground, GROUND) or Missing("The map and the path", map_command),
        "sheets": [_sheet(path) for path in results.contact_sheets]
        or [Missing("The contact sheet", "make contact-sheet")],
        "promises": len(promises),
        "kept": sum(row["kept"] for row in promises),
        "flights": len(results.audits),
    }
