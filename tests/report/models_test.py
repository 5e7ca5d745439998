# SPDX-License-Identifier: Apache-2.0
"""Costs of programming models, and verdicts, on synthetic results."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import made  # noqa: E402
from mandelreport.answers import verdict  # noqa: E402
from mandelreport.bench import Bench, Row  # noqa: E402
from mandelreport.backends import Backends  # noqa: E402
from mandelreport.models import Costs, label, ranked, with_scalar  # noqa: E402
from mandelreport.sections.tables import quotient_cell  # noqa: E402

BACKENDS = Backends(("openmp", "stdpar", "kokkos", "vulkan", "reference"))


def bench(*rows: dict[str, Any]) -> Bench:
    return Bench("made", Path("made"), made.bench("standard", list(rows)))


def row(backend: str, seconds: float, value: str = "", threads: int = 2, simd_width: int = 1, operations: float = 1e9, speed: float | None = None) -> dict[str, Any]:
    made_row = made.row("mandelbulb", "float", "fast", backend, seconds, value) | {"threads": threads, "simd_width": simd_width, "operations": operations}
    made_row["figures"] |= {"over_scalar": speed, "over_scalar_interval": speed and [0.9 * speed, 1.1 * speed]}
    return made_row


SCALAR = row("openmp", 0.4, "simd-width=1")


class CostTest(unittest.TestCase):
    def test_a_model_on_one_thread_is_compared_thread_for_thread(self) -> None:
        costs = Costs(bench(SCALAR, row("stdpar", 0.4, speed=0.99), row("kokkos", 0.8, threads=1, speed=0.5)), BACKENDS)
        self.assertEqual({name: speeds[0][0] for name, speeds in costs.speeds.items()}, {"stdpar": 0.99, "kokkos": 1.0})

    def test_less_work_and_simd_are_no_cost_of_a_model(self) -> None:
        others = [row("stdpar", 0.1, operations=5e8, speed=4.0), row("kokkos", 0.1, simd_width=8, speed=4.0), row("vulkan", 0.1, speed=4.0)]
        self.assertEqual(Costs(bench(SCALAR, row("openmp", 0.1, simd_width=48, speed=4.0), *others), BACKENDS).speeds, {})

    def test_one_thread_and_the_scalar_text_are_marked(self) -> None:
        rows = [row("openmp", 0.1, simd_width=48), SCALAR, row("kokkos", 0.8, threads=1), row("vulkan", 0.2, threads=1)]
        self.assertEqual([label(Row(data)) for data in rows], ["openmp", "openmp-scalar", "kokkos (1 thread)", "vulkan"])
        self.assertEqual(ranked(with_scalar(bench(*rows), "reference")), ["openmp", "vulkan", "openmp-scalar", "kokkos (1 thread)"])

    def test_a_baseline_beside_itself_has_no_interval(self) -> None:
        self.assertEqual(quotient_cell(Row(row("reference", 1, speed=1.0)), "over_scalar"), "1")
        self.assertEqual(quotient_cell(Row(row("reference", 1, speed=1.1)), "over_scalar"), "1.10 [0.99 – 1.21]")


class VerdictTest(unittest.TestCase):
    def test_there_are_four(self) -> None:
        for interval, expected in (
            ([0.4, 0.6], "it is faster"), ([1.1, 1.2], "it is slower"), ([0.5, 1.5], "undecided"), ([0.99, 1.01], "the same within"),
            ([1.001, 1.01], "the same within"), ([1.001, 1.05], "it is slower"), (None, "undecided"),
        ):
            self.assertIn(expected, verdict({"ratio": {"interval": interval}}), interval)


if __name__ == "__main__":
    unittest.main(verbosity=2)
