# SPDX-License-Identifier: Apache-2.0
"""Each backend's design, from the documentation, and film frames on several machines."""

from __future__ import annotations

from typing import Any

from ..blocks import Missing
from ..docs import chapter, paragraph
from . import Material


def section(material: Material) -> dict[str, Any]:
    return {
        "masked": paragraph("docs/design.md", "Masked style"),
        "resumable": paragraph("docs/design.md", "Resumable"),
        "busy": paragraph("docs/design.md", "Busy lanes"),
        "simd": paragraph("docs/design.md", "SIMD"),
        "fewer": paragraph("docs/design.md", "Fewer steps"),
        "vulkan": paragraph("docs/design.md", "Vulkan"),
        "openacc": paragraph("docs/openacc.md", "Two kernels a pixel"),
        "times": paragraph("docs/openacc.md", "Times"),
        "k40_text": paragraph("docs/openacc.md", "Checks without a K40 or an H100"),
        "k40": material.results.k40,
        "no_k40": Missing("The K40's registers", "make k40"),
        "machines": chapter("docs/flight.md", "Many machines"),
        "film": chapter("docs/flight.md", "From the path to the film"),
    }
