#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""native_scalar_test.py: tools/native_scalar.py computes the ratio of two programs' user times, and reports a missing
build."""
import random
import sys
import unittest
from unittest import mock

from tool import ToolTest

import native_scalar

CASE = ("mandelbulb", "double", "exact")


class NativeScalarTest(ToolTest):
    def ratio(self, factor):
        """Returns the computed ratio for synthetic times. The second program's times are `factor` times the first
        one's; each time has an error of 1 %."""
        noise = random.Random(1)
        random.seed(1)  # fixes the programs' order; for one order in 20 the interval misses the true ratio

        def seconds(program, _):
            return (factor if program == "native" else 1) * noise.gauss(1, 0.01)

        with mock.patch.object(native_scalar, "user_seconds", seconds):
            return native_scalar.measured(["present", "native"], CASE, 16, "/nonexistent")

    def test_a_faster_program_is_found(self):
        ratio, low, high = self.ratio(1 / 1.1)
        self.assertTrue(1.05 < low < ratio < high < 1.15, (low, ratio, high))

    def test_equal_programs_have_an_interval_around_one(self):
        _, low, high = self.ratio(1)
        self.assertTrue(low < 1 < high, (low, high))

    def test_user_time_is_that_of_the_process(self):
        busy = native_scalar.user_seconds(sys.executable, ["-c", "sum(range(10**7))"])
        self.assertGreater(busy, native_scalar.user_seconds(sys.executable, ["-c", "import time; time.sleep(0.3)"]))

    def test_no_build_is_one_line(self):
        done = self.run_tool("native_scalar.py", ".")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("native_scalar: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
