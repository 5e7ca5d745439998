# SPDX-License-Identifier: Apache-2.0
"""Output of flythrough for the report: maps, audits, and summaries of films."""

from dataclasses import dataclass
from typing import Any

from .blocks import Table
from .errors import InputError
from .text import digits, plain

SERIES = ("x", "y", "z", "clearance", "turn")


@dataclass(frozen=True)
class FlightMap:
    """A map of a flight. `data` has balls and gates as (x, y, z, clearance), and series with one value per frame, in
    which turns are in degrees."""

    name: str
    data: dict[str, Any]

    @property
    def fractal(self) -> str:
        return self.data["fractal"]

    @property
    def hull(self) -> float:
        """Returns the size of the hull: half the cube's edge, or the sphere's radius."""
        return self.data["hull"]["size"]

    @property
    def seconds(self) -> list[float]:
        """Returns the time of each frame, from the start of the flight."""
        return [i / self.data["frames_per_second"] for i in range(len(self.data["x"]))]


@dataclass(frozen=True)
class Audit:
    """`promises`: for each promise, true if it is kept."""

    table: Table
    promises: list[bool]


def read_map(name: str, data: dict[str, Any]) -> FlightMap:
    lengths = {len(data[key]) for key in SERIES}
    if len(lengths) != 1 or 0 in lengths:
        raise InputError(f"{name}: the series {', '.join(SERIES)} must have one number of frames, at least 1")
    return FlightMap(name, data)


def read_audit(data: dict[str, Any]) -> Audit:
    if data["schema"] != 1:
        raise ValueError(f"schema {data['schema']}")
    lines = []
    for row in data["rows"]:
        name, unit = row["name"], f" {row['unit']}" if row["unit"] else ""
        kept = "kept" if row["kept"] else "BROKEN" if row["promise"] else "missed"
        bar = ("≤ " if row["at_most"] else "≥ ") + plain(row["bar"]) + unit
        lines.append(["!" if row["promise"] else "", name, plain(row["value"]) + unit, bar, kept, row["worst"]])
    table = Table(
        ["", "item", "value", "threshold", "", "worst"],
        lines,
        f"Audit of the {data['fractal']}'s flight, seed {data['seed']}, {data['frames']:,} frames. Items with ! are promises and "
        "must be kept; the others describe quality.",
        [2, 3],
    )
    return Audit(table, [row["kept"] for row in data["rows"] if row["promise"]])


def read_film(name: str, data: dict[str, Any]) -> Table:
    """Returns the table that the assignment requires."""
    if data["version"] != 1:
        raise ValueError(f"version {data['version']}")
    device, rendered, seconds = data["device"], data["frames_rendered"], data["seconds"]
    kind = "GPU" if device["is_gpu"] else f"CPU, {data['threads']} threads" if data["threads"] else "CPU"
    rows = [
        ["GPU(s) or CPU used", f"{data['backend']}: {device['name']} ({kind})"],
        ["number of frames", f"{data['frames']:,}"],
        ["average seconds per frame", digits(seconds / rendered) if rendered else "no frame was rendered in this run"],
        ["frames rendered in this run, seconds", f"{rendered:,} in {digits(seconds)} s"],
        ["processes", str(data["processes"])],
        [
            "settings",
            f"{data['width']} x {data['height']}, {data['samples']} x {data['samples']} samples per pixel, "
            f"{data['precision']}, {data['mode']}",
        ],
    ]
    return Table(["", data["fractal"]], rows, f"The film, from {name}. The time includes rendering, filtering and encoding.")
