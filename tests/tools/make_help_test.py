# SPDX-License-Identifier: Apache-2.0
"""`make help` prints for every target its result and its time."""
import os
import re
import subprocess
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TIME = re.compile(r"\((?=[^()]*(\d (s|min|hours)|\bhour|at once|as long as it builds))[^()]*\)$")


class MakeHelpTest(unittest.TestCase):
    def test_every_target_has_a_time(self):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
        run = subprocess.run(["make", "-s", "-C", ROOT, "help"], capture_output=True, text=True, check=True, env=environment)
        lines = run.stdout.splitlines()
        self.assertGreater(len(lines), 30)
        self.assertEqual([line for line in lines if not TIME.search(line)], [])

    def test_a_line_without_a_time_would_be_found(self):
        self.assertIsNone(TIME.search("a report on report/results (large)"))


if __name__ == "__main__":
    unittest.main()
