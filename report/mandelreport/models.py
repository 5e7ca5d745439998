# SPDX-License-Identifier: Apache-2.0
"""Cost of a programming model: its time divided by that of the host's scalar kernel for the same work, per thread."""

import math
import statistics
from collections.abc import Callable
from typing import Any

from markupsafe import Markup

from .bench import SAME_WORK, Backends, Bench, Row, count


def with_scalar(bench: Bench, reference: str) -> list[Row]:
    """Returns all timed rows except the reference's. Unlike Bench.rows, includes the scalar kernel's rows."""
    return [row for row in bench.all_rows if row.timed and row.backend != reference]


def ranked(rows: list[Row]) -> list[str]:
    """Returns the labels of rows, fastest first. For each fractal, precision and mode, the kernel time is divided by
    that of the fastest row. The order is that of the geometric mean of these ratios."""
    best: dict[tuple[str, ...], float] = {}
    for row in rows:
        best[row.kind] = min(best.get(row.kind, math.inf), row.kernel.median)
    logs: dict[str, list[float]] = {}
    for row in rows:
        logs.setdefault(row.label, []).append(math.log(row.kernel.median / best[row.kind]))
    return sorted(logs, key=lambda name: statistics.mean(logs[name]))


class Costs:
    """`speeds`: by backend, the rows that do the same work as the scalar kernel without explicit SIMD, with their
    speeds per thread, relative to the scalar kernel's."""

    def __init__(self, bench: Bench, backends: Backends):
        self.bench, self.host = bench, backends.host
        # Each tuple: speed, the scalar kernel's threads divided by the row's, row.
        self.speeds: dict[str, list[tuple[float, float, Row]]] = {}
        for row in bench.rows:
            # A driver's compiler may vectorise the kernel, on a number of threads of its own.
            if row.is_gpu or row.simd_width != 1 or row.backend == self.host or row.backend not in bench.in_cpp:
                continue
            work = row.work_over_scalar(self.host) if row.timed else None
            if work is None or abs(work - 1) > SAME_WORK:
                continue
            scalar = row.scalar(self.host)
            if scalar is not None and row.figures["over_scalar"] is not None:
                threads = scalar.threads / row.threads
                self.speeds.setdefault(row.backend, []).append((threads * row.figures["over_scalar"], threads, row))

    def _end(self, pick: Callable[..., Any], speeds: list[tuple[float, float, Row]]) -> Markup:
        _, threads, row = pick(speeds, key=lambda one: one[0])
        at = f"{row.at}/figures/over_scalar"
        return self.bench.with_interval(at, f"{at}_interval", threads)

    def answer(self) -> dict[str, Any] | None:
        """Returns the slowest and the fastest case of each model. Models that run on as many threads as the scalar
        kernel come before models that run on one thread."""
        groups: dict[str, list[dict[str, Any]]] = {}
        for backend, speeds in sorted(self.speeds.items(), key=lambda item: item[1][0][1]):
            words = "on one thread, speed per thread" if speeds[0][1] > 1 else "On as many threads"
            ends = {"least": self._end(min, speeds), "most": self._end(max, speeds)}
            groups.setdefault(words, []).append({"backend": backend, **ends})
        if not groups:
            return None
        every = [one for speeds in self.speeds.values() for one in speeds]
        cases = self.bench.timed(backend=next(iter(self.speeds)), sweep_value="")
        return {
            "groups": list(groups.items()),
            "backends": [model["backend"] for models in groups.values() for model in models],
            "least": self._end(min, every),
            "most": self._end(max, every),
            "cheap": min(speed for speed, *_ in every) > 0.8,
            "cases": count(cases),
            "size": self.bench.size,
        }
