# SPDX-License-Identifier: Apache-2.0
"""The front page: the findings, each answer with its number and interval."""

from __future__ import annotations

from typing import Any

from ..blocks import Missing
from ..figures.front import times
from ..figures.ladder import ladder, ladder_table
from ..text import join
from . import Material

# Names as spelled by their authors.
MODELS = {
    "openmp": "OpenMP",
    "stdpar": "C++ standard parallelism",
    "kokkos": "Kokkos",
    "openacc": "OpenACC",
    "omptarget": "OpenMP target directives",
    "cuda": "CUDA",
    "opencl": "OpenCL",
    "vulkan": "Vulkan",
}


def section(material: Material) -> dict[str, Any]:
    answers = material.answers
    cost = answers.cost()
    timed = answers.primary.values("backend") if answers.primary else []
    return {
        "models": join([MODELS.get(name, name) for name in timed if name != material.backends.reference] or ["several models"]),
        "same": answers.same(),
        "cost": cost and cost | {"backends": join(cost["backends"])},
        "gpu_measured": material.results.gpu_measured(),
        "fastest": answers.fastest(),
        "speed_ups": answers.speed_ups(),
        "ladder": [
            block
            for bench in material.results.study("ladder")
            for block in (ladder(bench), *(ladder_table(bench, fractal) for fractal in bench.values("fractal")))
        ],
        "no_ladder": Missing("The ladder", "bin/bench --study ladder --json report/results/ladder.json"),
        "fractals": answers.box_or_bulb(),
        "float": answers.float_or_double(),
        "gpu": answers.gpu(),
        "film": answers.film(),
        "figure": times(answers.primary, material.backends) if answers.primary else None,
        "bench": Missing("This answer", "make bench"),
        "no_gpu": Missing("This answer", "make k40"),
        "no_film": Missing("This answer", "bin/flythrough film --output video.mp4 --summary report/results/film.json"),
        "file": answers.primary.name if answers.primary else "",
        "runs": answers.primary.data["runs"] if answers.primary else 0,
        "machine": answers.primary.machine if answers.primary else "",
    }
