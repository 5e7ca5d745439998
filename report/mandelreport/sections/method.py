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


HOST_COMPILERS = ("GNU", "Clang")


def _baseline(material: Material) -> str:
    """Returns sentences that name the instruction sets for which the host's backends are compiled and, if it was
    measured, the models' gain from -march=native."""
    bench = material.answers.primary
    if bench is None:
        return ""
    backends = [b for b in bench.environment["backends"] if b["compiler"].startswith(HOST_COMPILERS)]
    plain = [b["name"] for b in backends if "-march" not in b["flags_exact"] + b["flags_fast"] and b["name"] != material.backends.host]
    built = Markup("").join(_built_for_this_machine(material, file) for file in material.results.duels)
    if not plain:
        return built
    host = material.backends.host
    text = Markup(
        "The scalar kernel and {} are compiled without -march, for the compiler's baseline ({}). {}'s packs select their "
        "instructions at run time; OpenCL and Vulkan compile for the processor on which they run."
    ).format(join(plain), named("x86-64: SSE2, no fused multiply-add"), host)
    return text + built


def _built_for_this_machine(material: Material, file: str) -> Markup:
    """Returns a sentence on a duel if its second program was compiled with -march=native; otherwise returns no text."""
    duel = material.results.files[file]
    build, cpu = duel["new"]["environment"]["build"], duel["new"]["environment"]["cpu"]
    if "-march=native" not in build["flags"]:
        return Markup()
    ends = []
    for mode in ("exact", "fast"):
        verdicts = enumerate(duel["verdicts"])
        ratios = [material.results.number(file, f"/verdicts/{at}/ratio") for at, one in verdicts if mode in one["name"]]
        ends += [pick(ratios, key=lambda number: number.value).html() for pick in (min, max)] if ratios else [Markup("-")] * 2
    return Markup(" Compiled by {} with -march=native, the models take {} to {} times as long in exact mode and {} to {} times in fast mode (on {}; {}).").format(
        named(build["compiler"]), *ends, named(cpu["platform"]), file
    )


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
        "Results of the standard study. Appendix F uses their letters.",
        [4],
    )
    return {"table": table if rows else Missing("The results", "make bench"), "baseline": _baseline(material)}
