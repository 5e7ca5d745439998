# SPDX-License-Identifier: Apache-2.0
"""Subject, machines and method of the measurements."""

from typing import Any

from markupsafe import Markup

from ..answers import named
from ..bench import Bench
from ..blocks import Missing, Table
from ..text import join
from . import Material


def instructions(bench: Bench, host: str) -> str:
    rows = [row for row in bench.timed(backend=host) if row.instruction_set]
    return ", ".join(dict.fromkeys(row.instruction_set for row in rows))


def _baseline(material: Material) -> str:
    """Returns a sentence that names the instruction sets for which the host's backends are compiled."""
    bench = material.answers.primary
    if bench is None:
        return ""
    backends = [b for b in bench.environment["backends"] if b["name"] in bench.in_cpp]
    plain = [b["name"] for b in backends if "-march" not in b["flags_exact"] + b["flags_fast"] and b["name"] != material.backends.host]
    if not plain:
        return ""
    host = material.backends.host
    return Markup(
        "The scalar kernel and {} are compiled without -march, for the compiler's baseline ({}). {}'s packs select their "
        "instructions at run time; drivers compile for the processor on which they run."
    ).format(join(plain), named("x86-64: SSE2, no fused multiply-add"), host)


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
    return {"table": table if rows else Missing("The results", "make bench"), "baseline": _baseline(material)}
