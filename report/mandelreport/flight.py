# SPDX-License-Identifier: Apache-2.0
"""Output of flythrough for the report: maps, audits, and summaries of films."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from .errors import InputError

MAP_FORMAT = "mandelmarch flight map 1"
FILM_SCHEMA = "mandelmarch-film"
SERIES = ("x", "y", "z", "clearance", "turn")


@dataclass(frozen=True)
class FlightMap:
    """Balls and gates as (x, y, z, clearance); series have one value per frame; turns are in degrees."""

    name: str
    data: dict[str, Any]

    @property
    def fractal(self) -> str:
        return self.data["fractal"]

    @property
    def hull(self) -> float:
        """Returns half the cube's edge, or the sphere's radius."""
        return self.data["hull"]["size"]

    def series(self, key: str) -> list[float]:
        return self.data[key]

    @property
    def seconds(self) -> list[float]:
        """Returns the time of each frame."""
        return [i / self.data["frames_per_second"] for i in range(len(self.data["x"]))]


@dataclass(frozen=True)
class Audit:
    name: str
    data: dict[str, Any]


@dataclass(frozen=True)
class Film:
    """`seconds`: time to render `rendered` frames; `device`: as named by flythrough, or the backend's line of a log."""

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
    missing = [
        key
        for key in (
            "fractal",
            "seed",
            "hull",
            "frames_per_second",
            "balls",
            "gates",
            "ball_count",
            "gate_count",
            "passages",
            *SERIES,
        )
        if key not in data
    ]
    if missing:
        raise InputError(f"{name}: the flight map lacks {', '.join(missing)}")
    lengths = {len(data[key]) for key in SERIES}
    if len(lengths) != 1 or 0 in lengths:
        raise InputError(f"{name}: the series {', '.join(SERIES)} must have one number of frames, at least 1")
    return FlightMap(name, data)


def read_audit(name: str, data: dict[str, Any]) -> Audit:
    if data.get("schema") != 1:
        raise InputError(f"{name}: version {data.get('schema')} of a flight audit, expected 1")
    rows = data.get("rows")
    wanted = {"name", "value", "bar", "at_most", "promise", "unit", "kept", "worst"}
    if not isinstance(rows, list) or not all(isinstance(row, dict) and wanted <= row.keys() for row in rows):
        raise InputError(f"{name}: an audit's rows need {', '.join(sorted(wanted))}")
    return Audit(name, data)


def read_film(name: str, data: dict[str, Any]) -> Film:
    if data.get("version") != 1:
        raise InputError(f"{name}: version {data.get('version')} of a film summary, expected 1")
    try:
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
    except (KeyError, TypeError) as error:
        raise InputError(f"{name}: the film summary lacks {error}") from None


def film_of_log(name: str, text: str) -> Film | None:
    """Returns the film described by a log of flythrough's stderr, or None if the log ends before the film is
    complete."""
    done = re.search(r"^film: (\d+) of (\d+) segments rendered in ([\d.]+) s by (\d+) process", text, re.M)
    frames = re.search(r"^(\w+), seed \d+, (\d+) frames", text, re.M)
    if not done or not frames or done[1] != done[2]:
        return None
    device = re.search(r"^backend (.+)$", text, re.M)
    return Film(
        name,
        frames[1],
        device[1] if device else "not in the log",
        int(frames[2]),
        int(frames[2]),
        float(done[3]),
        int(done[4]),
        "",
    )
