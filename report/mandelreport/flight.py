# SPDX-License-Identifier: Apache-2.0
"""Output of flythrough for the report: maps, audits, and summaries of films."""

from dataclasses import dataclass
from typing import Any

from .errors import InputError

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
class Film:
    """A rendered film. `seconds`: the time to render `rendered` frames."""

    name: str
    fractal: str
    device: str
    frames: int
    rendered: int
    seconds: float
    processes: int
    details: str

    @property
    def per_frame(self) -> float | None:
        return self.seconds / self.rendered if self.rendered else None


def read_map(name: str, data: dict[str, Any]) -> FlightMap:
    lengths = {len(data[key]) for key in SERIES}
    if len(lengths) != 1 or 0 in lengths:
        raise InputError(f"{name}: the series {', '.join(SERIES)} must have one number of frames, at least 1")
    return FlightMap(name, data)


def read_audit(data: dict[str, Any]) -> dict[str, Any]:
    if data["schema"] != 1:
        raise ValueError(f"schema {data['schema']}")
    rows = [{key: row[key] for key in ("name", "value", "bar", "at_most", "promise", "unit", "kept", "worst")} for row in data["rows"]]
    return {key: data[key] for key in ("fractal", "seed", "frames")} | {"rows": rows}


def read_film(name: str, data: dict[str, Any]) -> Film:
    if data["version"] != 1:
        raise ValueError(f"version {data['version']}")
    device = data["device"]
    kind = "GPU" if device["is_gpu"] else f"CPU, {data['threads']} threads" if data["threads"] else "CPU"
    details = (
        f"{data['width']} x {data['height']}, {data['samples']} x {data['samples']} samples per pixel, "
        f"{data['precision']}, {data['mode']}"
    )
    return Film(
        name,
        data["fractal"],
        f"{data['backend']}: {device['name']} ({kind})",
        data["frames"],
        data["frames_rendered"],
        data["seconds"],
        data["processes"],
        details,
    )
