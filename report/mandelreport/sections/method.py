# SPDX-License-Identifier: Apache-2.0
"""Subject, machines and method of the measurements."""

from __future__ import annotations

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


HOST_COMPILERS = ("GNU", "Clang")


def _baseline(material: Material) -> str:
    """Names the instruction sets of the host's backends, and the scalar kernel's gain from -march=native."""
    bench = material.answers.primary
    if bench is None:
        return ""
    backends = [b for b in bench.environment["backends"] if b["compiler"].startswith(HOST_COMPILERS)]
    plain = [b["name"] for b in backends if "-march" not in b["flags_exact"] + b["flags_fast"] and b["name"] != material.backends.host]
    if not plain:
        return ""
    host = material.backends.host
    text = Markup(
        "The scalar kernel and {} are compiled without -march, for the compiler's baseline ({}). {}'s packs select their "
        "instructions at run time; OpenCL and Vulkan compile for the processor on which they run."
    ).format(join(plain), named("x86-64: SSE2, no fused multiply-add"), host)
    file = next((name for name, held in material.results.files.items() if str(held).startswith("scalar text with -march=native")), None)
    if file is None:
        return text
    lines = material.results.files[file].splitlines()
    modes = [[f"/{at}/3" for at, line in enumerate(lines) if line.split()[2:3] == [mode]] for mode in ("exact", "fast")]
    ratios = [[material.results.number(file, place) for place in places] for places in modes]
    ends = [pick(of, key=lambda number: number.value).html() for of in ratios for pick in (min, max)]
    machine = next(line for line in lines if line.startswith("processor")).split(maxsplit=1)[1]
    return text + Markup(
        " With -march=native the scalar kernel is {} to {} times as fast in exact mode, with the same bits, and {} to {} times in fast mode (on {}; {})."
    ).format(*ends, named(machine), file)


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
                str(bench.data["runs"]),
                instructions(bench, material.backends.host),
                git["revision"][:7] + (" and changes" if git["dirty"] else ""),
            ]
        )
    table = Table(
        ["", "file", "machine", "pixels", "runs", "SIMD", "revision"],
        rows,
        "Results of the standard study; the tables below use their letters.",
        [4],
    )
    return {"table": table if rows else Missing("The results", "make bench"), "baseline": _baseline(material)}
