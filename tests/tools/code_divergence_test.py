#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""code_divergence_test.py: tools/code_divergence.py counts lines of code, finds the files that a backend needs, and
computes the mean distance over all pairs of backends."""
import csv
import itertools
import json
import os
import sys
import unittest

from tool import ToolTest

import code_divergence

# Two backends, and a reference that does not use the kernel.
TREE = {
    "core/kernel/text.h": "#include MM_FRACTAL_FILE\nint text;\n",
    "core/kernel/fractals/one.h": "int fractal;\n",
    "core/kernel/prelude/left.h": "int left;\n",
    "core/job/job.h": "int job;\n// a comment\n",
    "core/job/loops.cpp.in": "int loops;\n",
    "backends/CMakeLists.txt": "set(backends\n    yardstick\n    left\n    right\n)\n",
    "backends/yardstick/y.cpp": "int y;\n",
    "backends/left/CMakeLists.txt": "add_library(left l.cpp)\n",
    "backends/left/l.cpp": '#include "../../core/kernel/prelude/left.h"\n#include "core/kernel/text.h"\n',
    "backends/right/r.cpp": '#include "core/job/job.h"\n#include "core/kernel/text.h"\n',
    "backends/right/loops.cpp.in": "int loops;\nint more;\n",
}


class LinesTest(unittest.TestCase):
    def test_blank_lines_and_comments_are_not_code(self):
        for text, lines in (("int a;\n\n  // b\nint c; // d\n", [1, 4]), ("/* a\nint b;\n*/ int c;\n", [3]),
                            ('f("// no comment");\n"/*" + a;\nb;', [1, 2, 3]), ('"\\"/*";\na;\n', [1, 2]),
                            ("// the end", []), ("a;\n/* no end\nb;", [1])):
            self.assertEqual(code_divergence.lines_of_code(text), lines, text)

    def test_convergence_is_one_minus_the_mean_of_jaccards_distances(self):
        # The sets have 4 and 3 lines and share 2 of them. Together they have 5 lines.
        one, other = {"a": [1, 2], "b": [1, 2]}, {"a": [1, 2], "c": [7]}
        self.assertEqual(code_divergence.distance(one, one), 0)
        self.assertAlmostEqual(code_divergence.distance(one, other), 1 - 2 / 5, places=15)
        self.assertEqual(code_divergence.distance(one, {}), 1)
        self.assertEqual(code_divergence.distance({}, {}), 0)
        self.assertAlmostEqual(code_divergence.convergence([one, other, one]), 1 - 2 * (1 - 2 / 5) / 3, places=15)
        self.assertEqual(code_divergence.convergence([one]), 1)


class TreeTest(ToolTest):
    def setUp(self):
        super().setUp()
        for name, text in TREE.items():
            self.write("tree/" + name, text)

    def result(self):
        return json.loads(self.run_tool("code_divergence.py", "tree", "--json", "-").stdout)

    def refused(self, *arguments):
        """Runs the tool, expects exit code 2 and a single line on stderr, and returns this line."""
        done = self.run_tool("code_divergence.py", *arguments)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
        return done.stderr

    def test_a_backend_needs_its_folder_and_the_files_that_it_names(self):
        result = self.result()
        left, right = ([model[key] for key in ("backend", "lines", "lines_of_job", "lines_of_kernel")]
                       for model in result["models"])
        self.assertEqual(left, ["left", 2, 0, 4])
        # For the backend `right`, its own template counts instead of the one in core/job.
        self.assertEqual(right, ["right", 4, 1, 3])
        # The backends need 6 and 8 lines and share 3 of them. Together they need 11 lines.
        self.assertAlmostEqual(result["convergence"], 3 / 11, places=15)
        self.assertEqual(result["convergence_without_shared_kernel"], 0)

    def test_a_line_more_in_a_backend_is_more_divergence(self):
        """Negative control: an additional comment changes nothing, but an additional line of code does."""
        before = self.result()
        self.write("tree/backends/left/l.cpp", TREE["backends/left/l.cpp"] + "// a comment\n\n")
        self.assertEqual(self.result(), before)
        self.write("tree/backends/left/l.cpp", TREE["backends/left/l.cpp"] + "int more;\n")
        self.assertAlmostEqual(self.result()["convergence"], 3 / 12, places=15)

    def test_the_table_has_the_same_numbers(self):
        lines = self.run_tool("code_divergence.py", "tree").stdout.splitlines()
        self.assertEqual(lines[2].split(), ["left", "2", "0", "4", "0.00", "0.73"])
        self.assertEqual(lines[-1], "code convergence: 0.273; with a kernel text for each it would be 0.000")

    def test_another_folder_is_refused(self):
        self.assertIn("expected the folder of the program's sources", self.refused("nowhere"))
        self.write("tree/backends/CMakeLists.txt", "set(backends left nosuch)\n")
        self.assertIn("backends/nosuch/: No such file or directory", self.refused("tree"))
        self.write("tree/backends/CMakeLists.txt", "set(others left)\n")
        self.assertIn("expected a list of backends", self.refused("tree"))
        os.remove(self.path("tree/core/kernel/text.h"))
        self.assertIn("expected the folder of the program's sources", self.refused("tree"))

    def test_the_csv_of_this_tree_gives_the_same_convergence_as_the_json(self):
        """Computes the convergence from the CSV as p3-analysis-library does."""
        done = self.run_tool("code_divergence.py", "--csv", "lines.csv", "--json", "lines.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        csv.field_size_limit(sys.maxsize)
        with open(self.path("lines.csv"), encoding="utf-8") as file:
            needed = [{(entry["file"], line) for entry in json.loads(row["coverage"]) for line in entry["used_lines"]}
                      for row in csv.DictReader(file)]
        result = json.loads(self.read("lines.json"))
        distances = [1 - len(a & b) / len(a | b) for a, b in itertools.combinations(needed, 2)]
        self.assertEqual(len(needed), len(result["models"]))
        self.assertGreater(len(needed), 4)
        self.assertAlmostEqual(1 - sum(distances) / len(distances), result["convergence"], places=12)
        self.assertLess(result["convergence_without_shared_kernel"], result["convergence"])

    def test_a_file_that_cannot_be_written_is_one_line(self):
        done = self.run_tool("code_divergence.py", "tree", "--json", "nosuch/lines.json")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertEqual(self.run_tool("code_divergence.py", "tree", "--json", "-", "--csv", "-").returncode, 2)


if __name__ == "__main__":
    unittest.main()
