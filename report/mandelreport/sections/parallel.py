# SPDX-License-Identifier: Apache-2.0
"""How it was parallelised: the profile, the threads, and what each technique is worth."""

from __future__ import annotations

import dataclasses
from typing import Any

from ..blocks import Block, Missing
from ..figures import sweeps
from ..figures.profile import STAGES, profile, stage_medians
from ..text import digits, percent
from . import Material
from .sweeps import THREADS, sweep


def _march(material: Material) -> str:
    """The march's share of the time, least to most, as words; empty without a profile."""
    shares = [
        stages["march"] / sum(stages.get(stage, 0) for stage in STAGES)
        for bench in material.results.study("profile")
        for stages in stage_medians(bench).values()
        if "march" in stages
    ]
    return f"marching takes {percent(min(shares), 0)} to {percent(max(shares), 0)} of the time" if shares else ""


def _scaling(material: Material) -> str:
    """Speed-up at as many threads as the processor has."""
    ratios = []
    for bench in material.results.study("threads"):
        cores = str(bench.environment["cpu"]["cores_usable"])
        for row in (row for row in bench.timed() if row.value == cores):
            alone = [r for r in bench.timed(fractal=row.fractal, precision=row.precision, mode=row.mode) if r.value == "1"]
            ratios += [one.kernel.median / row.kernel.median for one in alone]
    if not ratios:
        return ""
    return f"as many threads as cores are worth {digits(min(ratios))} to {digits(max(ratios))}; more threads than cores are worth nothing more."


def _worth(material: Material) -> str:
    """The technique that is worth most and that which is worth least, of those that leave the picture what it is."""
    found: dict[str, list[float]] = {}
    for bench in material.results.study("ablation"):
        for row in (row for row in bench.timed() if row.value not in ("none", "root")):
            of = [r for r in bench.timed(fractal=row.fractal, precision=row.precision, backend=row.backend) if r.value == "none"]
            found.setdefault(row.value, []).extend(row.kernel.median / base.kernel.median for base in of)
    found = {name: ratios for name, ratios in found.items() if ratios}
    if not found:
        return ""
    together = found.pop("all-four", [])
    most, least = (pick(found, key=lambda name: max(found[name])) for pick in (max, min))
    return (
        f"without {most} a picture takes up to {digits(max(found[most]))} times as long, without {least} at most {digits(max(found[least]))} times"
        + (f"; without the four that find empty space together up to {digits(max(together))} times." if together else ".")
    )


def _with(blocks: list[Block], see: str) -> list[Block]:
    return [dataclasses.replace(block, see=see) if block.kind == "figure" else block for block in blocks]


def section(material: Material) -> dict[str, Any]:
    results = material.results
    profiles: list[Block] = [figure for bench in results.study("profile") if (figure := profile(bench))]
    ablations: list[Block] = [figure for bench in results.study("ablation") if (figure := sweeps.ablation(bench))]
    march = _march(material)
    return {
        "march": march,
        "profiles": _with(profiles, f"{march}, in every fractal, number and mode.")
        or [Missing("The profile", "bin/bench --study profile --json report/results/profile.json")],
        "threads": _with(sweep(material, *THREADS), _scaling(material)),
        "ablation": _with(ablations, _worth(material))
        or [Missing("The ablation", "bin/bench --study ablation --json report/results/ablation.json")],
    }
