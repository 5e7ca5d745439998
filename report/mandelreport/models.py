# SPDX-License-Identifier: Apache-2.0
"""Cost of a programming model: its time over that of openmp's scalar kernel for the same work, per thread."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable
from typing import Any

from markupsafe import Markup

from .backends import Backends
from .bench import Bench, Row
from .text import where
from .trace import Place, Trace

SCALAR = "simd-width=1"  # sweep value of the scalar kernel's rows
DRIVERS = ("opencl", "vulkan", "cuda")  # these drivers compile and distribute the work, on an unknown number of threads
SAME_WORK = 1e-3  # in fast mode the last digits of counts differ


def one_thread(row: Row) -> bool:
    """Returns true if a backend leaves the host's other cores idle."""
    return row.threads == 1 and not row.is_gpu and row.backend not in DRIVERS


def label(row: Row) -> str:
    """Returns the name of a standard study's row in tables and charts."""
    return f"{where(row)}{row.application.removeprefix(row.backend)}{' (1 thread)' if one_thread(row) else ''}"


def scalar_text(bench: Bench, row: Row, host: str) -> Row | None:
    """Returns the scalar kernel's row for a row's fractal, precision and mode."""
    kind = ("fractal", "precision", "mode")
    rows = (Row(data) for data in bench.data["rows"] if data["backend"] == host and data["sweep_value"] == SCALAR)
    return next((r for r in rows if r.timed and all(r.data[key] == row.data[key] for key in kind)), None)


def work_over_scalar(bench: Bench, row: Row, host: str) -> float | None:
    """Returns a row's counted operations over the scalar kernel's; None if either is not counted."""
    scalar = scalar_text(bench, row, host)
    return row.operations / scalar.operations if scalar is not None and scalar.operations and row.operations else None


def traced_work(trace: Trace, file: str, name: str, over: str) -> Markup:
    """Returns a row's counted operations over another row's."""
    above, below = (Place((file,), f"rows:name={of}:operations") for of in (name, over))
    return trace.number(above, over=below)


def with_scalar(bench: Bench, reference: str) -> list[Row]:
    """Returns all timed rows except the reference's, including the scalar kernel's, which Bench.rows leaves out."""
    return [row for row in map(Row, bench.data["rows"]) if row.timed and row.backend != reference]


def ranked(rows: list[Row]) -> list[str]:
    """Returns the labels of rows, fastest first: by the mean logarithm of the kernel time over fractals, precisions and
    modes."""
    best: dict[tuple[str, ...], float] = {}
    for row in rows:
        kind = (row.fractal, row.precision, row.mode)
        best[kind] = min(best.get(kind, math.inf), row.kernel.median)
    logs: dict[str, list[float]] = {}
    for row in rows:
        logs.setdefault(label(row), []).append(math.log(row.kernel.median / best[row.fractal, row.precision, row.mode]))
    return sorted(logs, key=lambda name: statistics.mean(logs[name]))


class Costs:
    """`speeds`: for each backend, the rows that do the scalar kernel's work without explicit SIMD, and their speeds
    over the scalar kernel, per thread."""

    def __init__(self, bench: Bench, backends: Backends):
        self.bench, self.host = bench, backends.host
        self.speeds: dict[str, list[tuple[float, float, Row]]] = {}  # speed, scalar kernel's threads / row's, row
        for row in bench.rows:
            work = work_over_scalar(bench, row, self.host) if row.timed else None
            if work is None or abs(work - 1) > SAME_WORK or row.simd_width != 1 or row.backend in (self.host, *DRIVERS):
                continue
            scalar = scalar_text(bench, row, self.host)
            if scalar is not None and row.figures["over_scalar"] is not None:
                threads = scalar.threads / row.threads
                self.speeds.setdefault(row.backend, []).append((threads * row.figures["over_scalar"], threads, row))

    def _end(self, trace: Trace, pick: Callable[..., Any], speeds: list[tuple[float, float, Row]]) -> Markup:
        _, threads, row = pick(speeds, key=lambda one: one[0])
        at = f"rows:name={row.name}:figures:over_scalar"
        return trace.with_interval(self.bench.name, at, f"{at}_interval", scale=threads)

    def answer(self, trace: Trace) -> dict[str, Any] | None:
        """Returns the slowest and fastest case of each model; models on all of the scalar kernel's threads come before
        those on one."""
        groups: dict[str, list[dict[str, Any]]] = {}
        for backend, speeds in sorted(self.speeds.items(), key=lambda item: item[1][0][1]):
            words = "on one thread, speed per thread" if speeds[0][1] > 1 else "On as many threads"
            ends = {"least": self._end(trace, min, speeds), "most": self._end(trace, max, speeds)}
            groups.setdefault(words, []).append({"backend": backend, **ends})
        if not groups:
            return None
        every = [one for speeds in self.speeds.values() for one in speeds]
        first = next(iter(self.speeds))
        return {
            "groups": list(groups.items()),
            "backends": [model["backend"] for models in groups.values() for model in models],
            "least": self._end(trace, min, every),
            "most": self._end(trace, max, every),
            "cheap": min(speed for speed, *_ in every) > 0.8,
            "cases": trace.number(Place((self.bench.name,), f"rows:backend={first}&figures!=null&sweep_value=", "count"), "whole"),
            "size": self.bench.size,
        }
