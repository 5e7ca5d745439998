# SPDX-License-Identifier: Apache-2.0
"""Subject, machines and method of the measurements."""

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
                bench.size.replace(" x ", "\N{NO-BREAK SPACE}x\N{NO-BREAK SPACE}"),
                str(bench.data["runs"]),
                instructions(bench, material.backends.host).replace("-", "\N{NON-BREAKING HYPHEN}"),
                git["revision"][:7] + (" and changes" if git["dirty"] and git["revision"] != "unknown" else ""),
            ]
        )
    table = Table(
        ["", "file", "machine", "pixels", "runs", "SIMD", "revision"],
        rows,
        "Results of the standard study. Appendix E uses their letters.",
        [4],
    )
    return {"table": table if rows else Missing("The results", "make bench")}
