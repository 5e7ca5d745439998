# SPDX-License-Identifier: Apache-2.0
"""Sweeps: studies in which one setting varies. The sweep of threads and the ablation are in the main part."""

from typing import Any

from ..blocks import Block, Missing
from ..figures import sweeps
from . import Material

# Arguments of sweep(): study, title of x, quantity on y, caption.
SWEEPS = [
    (
        "resolution",
        "picture [pixels]",
        "rate",
        "Pixels per second by picture size. If a line is flat, twice the pixels take twice the time. Wide pictures have more "
        "background.",
    ),
    (
        "frames",
        "pictures from one fresh renderer",
        "ms",
        "Wall time per picture, including context and build: the cost of opening a device, and after how many pictures it is negligible.",
    ),
    ("simd-widths", "pixels at once on a core", "ms", "Kernel time by the number of pixels that a core computes at once."),
    (
        "tiles",
        "tiles that a thread takes at once",
        "ms",
        "Kernel time by the number of 16 x 16 tiles that a thread takes at once.",
    ),
    ("iterations", "limit of iterations", "ms", "Kernel time by the distance estimator's limit of iterations."),
    ("detail", "detail level D", "ms", "Kernel time by detail level: a ray hits the surface if DE < 10^D t."),
]
THREADS = ("threads", "threads", "speed-up", "Speed-up over one thread, with its interval. The last point uses twice the processor's threads.")
Y_TITLES = {"rate": "Mpixel/s", "speed-up": "speed-up", "ms": "time [ms]"}


def sweep(material: Material, study: str, x_title: str, y: str, caption: str) -> list[Block]:
    """Returns a figure for each result of the study or, if there is no result, a note with the command that makes
    one."""
    blocks: list[Block] = []
    for bench in material.results.study(study):
        about = f"{caption} {' and '.join(bench.values('mode')).capitalize()} mode; {bench.machine}."
        figure = sweeps.sweep(bench, x_title, Y_TITLES[y], about, y, ideal=study == "threads")
        if figure:
            blocks.append(figure)
    return blocks or [Missing(f"The study {study}", f"bin/bench --study {study} --json results/{study}.json")]


def section(material: Material) -> dict[str, Any]:
    return {"sweeps": [(entry[0], sweep(material, *entry)) for entry in SWEEPS]}
