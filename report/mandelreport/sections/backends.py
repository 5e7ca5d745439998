# SPDX-License-Identifier: Apache-2.0
"""Chapters of the documentation on the design of backends and on films, and the K40's registers."""

from typing import Any

from ..blocks import Missing, Output
from ..docs import chapter
from . import Material


def section(material: Material) -> dict[str, Any]:
    return {
        "masked": chapter("docs/design.md", "Masked style"),
        "resumable": chapter("docs/design.md", "Resumable"),
        "busy": chapter("docs/design.md", "Busy lanes"),
        "simd": chapter("docs/design.md", "SIMD"),
        "fewer": chapter("docs/design.md", "Fewer steps"),
        "vulkan": chapter("docs/design.md", "Vulkan"),
        "openacc": chapter("docs/openacc.md", "Separate kernels for marching and shading"),
        "times": chapter("docs/openacc.md", "Times"),
        "k40_text": chapter("docs/openacc.md", "Checks without a K40 or an H100"),
        "k40": Output(material.results.k40) if material.results.k40 else Missing("The K40's registers", "make k40"),
        "machines": chapter("docs/film.md", "Many machines"),
        "film": chapter("docs/film.md", "From the path to the film"),
    }
