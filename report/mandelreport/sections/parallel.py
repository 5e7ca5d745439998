# SPDX-License-Identifier: Apache-2.0
"""Parallelisation: the profile, the threads, and the gain from each technique."""

from __future__ import annotations

import dataclasses
from typing import Any

from markupsafe import Markup

from ..bench import Bench, Row
from ..blocks import Block, Missing
from ..figures import sweeps
from ..figures.profile import STAGES, profile, stage_medians
from . import Material
from .sweeps import THREADS, sweep


def _march(material: Material) -> str:
    """Returns the statement that marching takes most of the time, or no text if a profile contradicts it."""
    shares = [
        stages["march"] / sum(stages.get(stage, 0) for stage in STAGES)
        for bench in material.results.study("profile")
        for stages in stage_medians(bench).values()
        if "march" in stages
    ]
    return "marching takes most of the time" if shares and min(shares) > 0.5 else ""


def _traced(material: Material, bench: Bench, row: Row) -> Markup:
    """Formats the ratio of a row's time to that of the sweep's first value, with its interval."""
    return material.results.times(bench.name, bench.ratio_at("to_first_value", row.name))


def _scaling(material: Material) -> str:
    """Returns a sentence that compares the time on as many threads as cores with the time on one thread."""
    found = []
    for bench in material.results.study("threads"):
        cores = str(bench.environment["cpu"]["cores_usable"])
        found += [(bench, row, over) for row in bench.timed() if row.value == cores and (over := bench.compared("to_first_value", row))]
    if not found:
        return ""
    least, most = (_traced(material, *pick(found, key=lambda one: one[2].median)[:2]) for pick in (min, max))
    return Markup("with as many threads as cores, a picture takes {} to {} of the time on one thread; more threads than cores gain nothing.").format(least, most)


def _worth(material: Material) -> str:
    """Returns a sentence on the techniques with the largest and the smallest gain, of those that do not change the
    picture."""
    longest: dict[str, tuple[float, Markup]] = {}
    for bench in material.results.study("ablation"):
        for row in (row for row in bench.timed() if row.value not in ("none", "refinement")):
            found = bench.compared("to_first_value", row)
            if found and found.median > longest.get(row.value, (0,))[0]:
                longest[row.value] = (found.median, _traced(material, bench, row))
    together = longest.pop("all-four", None)
    if not longest:
        return ""
    most, least = (pick(longest, key=lambda name: longest[name][0]) for pick in (max, min))
    text = Markup("without {} a picture takes up to {} times as long, without {} at most {} times").format(
        most, longest[most][1], least, longest[least][1]
    )
    if together is None:
        return text + "."
    return text + Markup("; without all four that find empty space, up to {} times.").format(together[1])


def _with(blocks: list[Block], see: str) -> list[Block]:
    return [dataclasses.replace(block, see=see) if block.kind == "figure" else block for block in blocks]


def section(material: Material) -> dict[str, Any]:
    results = material.results
    profiles: list[Block] = [figure for bench in results.study("profile") if (figure := profile(bench))]
    ablations: list[Block] = [figure for bench in results.study("ablation") if (figure := sweeps.ablation(bench))]
    march = _march(material)
    return {
        "march": march,
        "profiles": _with(profiles, f"{march}, for every fractal, precision and mode." if march else "")
        or [Missing("The profile", "bin/bench --study profile --json report/results/profile.json")],
        "threads": _with(sweep(material, *THREADS), _scaling(material)),
        "ablation": _with(ablations, _worth(material))
        or [Missing("The ablation", "bin/bench --study ablation --json report/results/ablation.json")],
    }
