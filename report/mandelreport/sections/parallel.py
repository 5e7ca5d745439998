# SPDX-License-Identifier: Apache-2.0
"""Parallelisation: the directives, the threads, and the gain from each technique."""

from typing import Any

from markupsafe import Markup

from ..bench import Bench, Row
from ..blocks import Block, Missing, Table, seen
from ..docs import code
from ..figures import sweeps
from ..figures.parallel import pixels
from . import Material
from .sweeps import THREADS, sweep

DISTRIBUTION = [
    ["openmp", "each thread takes tiles of 16 x 16 pixels from a shared counter; within a thread, packs of SIMD lanes with ended rays replaced"],
    ["openacc", "one GPU thread per pixel, or threads that take pixels from a queue if lanes refill; 128 threads per block; one kernel after the other per band of the picture: cones (in fast mode), march, shade, bytes"],
    ["omptarget, cuda", "one GPU thread per pixel, with the same kernels as openacc; on the host, omptarget's threads share the pixels"],
    ["stdpar, kokkos", "the model's own loop over the pixels of a band, one after the other in each thread"],
    ["opencl", "one work item per pixel on a GPU, per strip of pixels (in vectors) on a CPU"],
    ["vulkan", "one invocation per pixel, workgroups of 8 x 8 pixels, in passes short enough for watchdogs"],
    ["MPI", "each rank requests the next segment of frames, renders it on its own device and encodes it; ranks exchange only segment numbers"],
]
# The directives that distribute pixels: file, and the line at which the quotation begins.
DIRECTIVES = [
    ("backends/openacc/loops.cpp.in", "void march_@variant@("),
    ("backends/openmp/openmp.cpp", "#pragma omp parallel num_threads(threads_) reduction"),
]


def _traced(material: Material, bench: Bench, row: Row) -> Markup:
    """Formats the ratio of a row's time to that of the sweep's first value, with its interval."""
    return material.results.times(bench.name, bench.ratio_at("to_first_value", row.name))


def _scaling(material: Material) -> Markup:
    """Returns a sentence on the time on as many threads as cores, and on twice as many, relative to one thread."""
    parts = []
    for factor, words in ((1, "On as many threads as cores, a picture takes {} to {} of the time on one thread"), (2, "on twice as many, {} to {}")):
        found = [
            (bench, row, over)
            for bench in material.results.study("threads")
            for row in bench.timed()
            if row.value == str(factor * bench.environment["cpu"]["cores_usable"]) and (over := bench.compared("to_first_value", row))
        ]
        if found:
            ends = (pick(found, key=lambda one: one[2].median)[:2] for pick in (min, max))
            parts.append(Markup(words).format(*(_traced(material, *end) for end in ends)))
    return Markup(", ").join(parts)


def _threads(material: Material) -> list[Block]:
    """Returns the figures of the sweep of threads, or none if no machine has more than two cores."""
    studies = material.results.study("threads")
    few = studies and all(bench.environment["cpu"]["cores_usable"] <= 2 for bench in studies)
    return [] if few else sweep(material, *THREADS)


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


def section(material: Material) -> dict[str, Any]:
    results = material.results
    worth = _worth(material)
    ablations = [seen(figure, worth) for bench in results.study("ablation") if (figure := sweeps.ablation(bench))]
    return {
        "pixels": pixels(),
        "distribution": Table(["backend", "distribution of the work"], DISTRIBUTION, "Distribution of pixels and frames."),
        "directives": [(file, code(file, begin)) for file, begin in DIRECTIVES],
        "scaling": _scaling(material),
        "threads": _threads(material),
        "ablation": ablations
        or [Missing("The ablation", "bin/bench --study ablation --json results/ablation.json")],
    }
