#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_schedule_test.py: tools/gpu_schedule.py simulates schedules whose times are known by hand. Needs numpy, which the
report's pinned packages have (make python)."""
import os
import pathlib
import sys
import types
import unittest

try:
    import numpy as np
except ImportError as error:
    pinned = pathlib.Path(__file__).parents[2] / "build/venv/bin/python3"
    if pinned.exists() and sys.prefix == sys.base_prefix:
        os.execv(pinned, [pinned, *sys.argv])
    print(f"skipped: {error}", file=sys.stderr)
    sys.exit(1 if os.environ.get("MANDELMARCH_NEED_PYTHON") else 77)

import tool  # noqa: F401 (makes tools importable)

import gpu_schedule

# A GPU with one multiprocessor, which holds one block of four warps. Each of its quarters runs one of the warps. An
# iteration takes a cycle.
GPU = types.SimpleNamespace(multiprocessors=1, latency=1, quarters=lambda: 4)
MARCH = types.SimpleNamespace(step_cycles=0, round_cycles=1)
LANES = 32


def same(values):
    """Returns values for tiles whose lanes are all alike."""
    return np.repeat(np.array(values, float)[:, None], LANES, axis=1)


def ended(schedule):
    return gpu_schedule.simulated(GPU, 1, 2, schedule)


class ScheduleTest(unittest.TestCase):
    # The fourth of eight tiles takes nine cycles, all others one.
    EIGHT = same([1] * 8), same([1, 1, 1, 9, 1, 1, 1, 1]), np.arange(8)

    def test_a_block_begins_when_the_block_before_it_has_ended(self):
        self.assertEqual(ended(gpu_schedule.Tiles(MARCH, *self.EIGHT, queue=False))[0], 9 + 1)

    def test_with_a_queue_no_warp_waits_for_the_heavy_tile(self):
        self.assertEqual(ended(gpu_schedule.Tiles(MARCH, *self.EIGHT, queue=True)), (9, 3))

    def test_a_heavy_tile_at_the_end_of_the_queue_is_waited_for(self):
        order = np.array([0, 1, 2, 4, 5, 6, 7, 3])
        self.assertEqual(ended(gpu_schedule.Tiles(MARCH, *self.EIGHT[:2], order, queue=True))[0], 1 + 9)

    def test_lanes_that_are_refilled_wait_less(self):
        # One lane of each tile takes eight steps, the others four.
        steps = same([4] * 8)
        steps[:, 0] = 8
        picture = steps, same([1] * 8), np.arange(8)
        tiles, refill = gpu_schedule.Tiles(MARCH, *picture, queue=True), gpu_schedule.Refill(MARCH, *picture)
        self.assertEqual(ended(tiles), (16, 16))
        self.assertEqual(ended(refill), (12, 12))
        self.assertEqual(tiles.slots, 8 * 8 * LANES)
        self.assertEqual(refill.slots, 4 * 12 * LANES)


if __name__ == "__main__":
    unittest.main()
