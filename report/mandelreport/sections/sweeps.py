# SPDX-License-Identifier: Apache-2.0
"""Sweeps: one setting varies. Threads and the ablation are in the main part."""

from __future__ import annotations

from typing import Any

from ..blocks import Block, Missing
from ..figures import sweeps
from . import Material

# study, title of x, quantity on y, caption
SWEEPS = [
    (
        "resolution",
        "picture [pixels]",
        "rate",
        "Pixels a second over the picture's size: where a line is flat, twice the pixels take twice the time. Wide ones have "
        "more background.",
    ),
    (
        "frames",
        "pictures from one fresh renderer",
        "ms",
        "Wall time a picture, context and build included: what opening a device costs, and how many pictures pay for it.",
    ),
    ("packs", "pixels at once on a core", "ms", "Kernel time over the pixels that a core computes at once."),
    (
        "tiles",
        "tiles that a thread takes at once",
        "ms",
        "Kernel time over the tiles of 16 x 16 pixels that a thread takes at once.",
    ),
    ("iterations", "limit of iterations", "ms", "Kernel time over the distance estimator's limit of iterations."),
    ("detail", "detail level D", "ms", "Kernel time over the detail level: a surface is hit where DE < 10^D t."),
]
THREADS = ("threads", "threads", "speed-up", "Speed-up over one thread, with its interval. Twice the processor's threads is the last point.")
Y_TITLES = {"rate": "Mpixel/s", "speed-up": "speed-up", "ms": "time [ms]"}


def sweep(material: Material, study: str, x_title: str, y: str, caption: str) -> list[Block]:
    """Returns a figure for each result of the study, or a note how to make one."""
    blocks: list[Block] = []
    for bench in material.results.study(study):
        about = f"{caption} {' and '.join(bench.values('mode')).capitalize()} mode; {bench.machine}."
        figure = sweeps.sweep(bench, x_title, Y_TITLES[y], about, y, ideal=study == "threads")
        if figure:
            blocks.append(figure)
    return blocks or [Missing(f"The study {study}", f"bin/bench --study {study} --json report/results/{study}.json")]


def section(material: Material) -> dict[str, Any]:
    return {"sweeps": [(entry[0], sweep(material, *entry)) for entry in SWEEPS]}
