# SPDX-License-Identifier: Apache-2.0
"""Chapters of the documentation on the design of backends and on films."""

from typing import Any

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
        "checks": chapter("docs/openacc.md", "Checks without a GPU"),
        "machines": chapter("docs/film.md", "Many machines"),
        "film": chapter("docs/film.md", "From the path to the film"),
    }
