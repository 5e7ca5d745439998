# SPDX-License-Identifier: Apache-2.0
"""What was measured, on what, and how."""

from __future__ import annotations

from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from . import Material


def instructions(bench: Bench, host: str) -> str:
    rows = [row for row in bench.timed(backend=host) if row.instruction_set]
    return ", ".join(dict.fromkeys(row.instruction_set for row in rows))


def section(material: Material) -> dict[str, Any]:
    rows = []
    for bench in material.results.study("standard"):
        git = bench.environment["git"]
        rows.append(
            [
                material.letter(bench.name),
                bench.name,
                bench.machine,
                bench.size,
                str(bench.data["launches"]),
                instructions(bench, material.backends.host),
                git["revision"][:7] + (" and changes" if git["dirty"] else ""),
            ]
        )
    table = Table(
        ["", "file", "machine", "pixels", "launches", "SIMD", "revision"],
        rows,
        "Results of the standard study; tables below call them by their letters.",
        [4],
    )
    return {"table": table if rows else Missing("The results", "make bench"), "backends": material.backends.names[:-1]}
