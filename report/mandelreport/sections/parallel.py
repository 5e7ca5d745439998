# SPDX-License-Identifier: Apache-2.0
"""Parallelisation: the directives, the threads, and the gain from each technique."""

from typing import Any

from ..blocks import Block, Missing, Table
from ..figures import sweeps
from . import Material
from .sweeps import THREADS, sweep

RANKS = ["MPI", "each rank requests the next segment of frames, renders it on its own device and encodes it; ranks exchange only segment numbers"]


def _distribution(material: Material) -> Table:
    backends = material.backends
    lines = [[name, backends.facts[name]["distribution"]] for name in backends.names if name in backends.facts]
    return Table(["backend", "distribution of the work"], [*lines, RANKS], "Distribution of pixels and frames.")


def _threads(material: Material) -> list[Block]:
    """Returns the figures of the sweep of threads, or none if no machine has more than two cores."""
    studies = material.results.study("threads")
    few = studies and all(bench.environment["cpu"]["cores_usable"] <= 2 for bench in studies)
    return [] if few else sweep(material, *THREADS)


def section(material: Material) -> dict[str, Any]:
    results = material.results
    ablations = [figure for bench in results.study("ablation") if (figure := sweeps.ablation(bench))]
    return {
        "distribution": _distribution(material),
        "threads": _threads(material),
        "ablation": ablations
        or [Missing("The ablation", "bin/bench --study ablation --json results/ablation.json")],
    }
