# SPDX-License-Identifier: Apache-2.0
"""Section 3: how it was parallelised: the profile, then each backend, then frames."""

from __future__ import annotations

from typing import Any

from ..blocks import Block, Missing, Table
from ..docs import chapter, paragraph
from ..figures.profile import STAGES, profile, stage_medians
from ..text import digits, percent
from . import Material


def _march_shares(material: Material) -> str:
    """The march's share of the time, least to most, as words; empty without a profile."""
    shares = [
        stages["march"] / sum(stages.get(stage, 0) for stage in STAGES)
        for bench in material.results.study("profile")
        for stages in stage_medians(bench).values()
        if "march" in stages
    ]
    return f"{percent(min(shares), 0)} to {percent(max(shares), 0)}" if shares else ""


def _films(material: Material) -> Block:
    rows = [
        [
            film.fractal,
            film.device,
            str(film.processes),
            str(film.rendered),
            digits(film.seconds),
            digits(film.per_frame) if film.per_frame else "–",
            film.name,
        ]
        for film in material.results.films
    ]
    if not rows:
        return Missing("A film's times", "bin/flythrough film --output video.mp4 --summary report/results/film.json")
    return Table(
        ["fractal", "device", "processes", "frames", "seconds", "seconds a frame", "file"],
        rows,
        "Films that were made, by the processes that shared the work.",
        [2, 3, 4, 5],
    )


def section(material: Material) -> dict[str, Any]:
    profiles = [figure for bench in material.results.study("profile") if (figure := profile(bench))]
    return {
        "profiles": profiles or [Missing("The profile", "bin/bench --study profile --json report/results/profile.json")],
        "march": _march_shares(material),
        "masked": paragraph("docs/design.md", "Masked style"),
        "resumable": paragraph("docs/design.md", "Resumable"),
        "busy": paragraph("docs/design.md", "Busy lanes"),
        "simd": paragraph("docs/design.md", "SIMD"),
        "fewer": paragraph("docs/design.md", "Fewer steps"),
        "vulkan": paragraph("docs/design.md", "Vulkan"),
        "openacc": paragraph("docs/openacc.md", "Two kernels a pixel"),
        "times": paragraph("docs/openacc.md", "Times"),
        "k40_text": paragraph("docs/openacc.md", "The K40 without one"),
        "k40": material.results.k40,
        "no_k40": Missing("The K40's registers", "make k40"),
        "machines": chapter("docs/flight.md", "Many machines"),
        "film": chapter("docs/flight.md", "From the path to the film"),
        "films": _films(material),
    }
