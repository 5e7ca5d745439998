#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""lines_of_code_test.py: tools/lines_of_code.py counts lines of code, and finds the files that a backend needs."""
import json
import unittest

from tool import ToolTest

# Two backends, and a reference that does not use the kernel.
TREE = {
    "core/kernel/text.h": "#include MM_FRACTAL_FILE\nint text;\n",
    "core/kernel/fractals/one.h": "int fractal;\n",
    "core/kernel/prelude/left.h": "int left; // a comment\n",
    "core/models/job.h": "int job;\n// a comment\n",
    "core/models/loops.cpp.in": "int loops;\n",
    "backends/CMakeLists.txt": "set(backends\n    yardstick\n    left\n    right\n)\n",
    "backends/yardstick/y.cpp": "int y;\n",
    "backends/left/CMakeLists.txt": "add_library(left l.cpp)\n",
    "backends/left/l.cpp": '#include "../../core/kernel/prelude/left.h"\n#include "core/kernel/text.h"\n',
    "backends/right/r.cpp": '#include "core/models/job.h"\n#include "core/kernel/text.h"\n',
    "backends/right/loops.cpp.in": "int loops;\nint more;\n",
}
LEFT = "backends/left/l.cpp"


class LinesOfCodeTest(ToolTest):
    def setUp(self):
        super().setUp()
        for name, text in TREE.items():
            self.write("tree/" + name, text)

    def models(self):
        done = self.run_tool("lines_of_code.py", "tree")
        return [list(model.values()) for model in json.loads(done.stdout)["models"]]

    def test_a_backend_needs_its_folder_and_the_files_that_it_names(self):
        # For the backend `right`, its own template counts instead of the one in core/models.
        self.assertEqual(self.models(), [["left", 2, 0, 4], ["right", 4, 1, 3]])

    def test_blank_lines_and_comments_are_not_code(self):
        for text, lines in (("\n  // b\nint c; // d\n", 1), ("/* a\nint b;\n*/ int c;\n", 1), ("// the end", 0),
                            ('f("// no comment");\n"/*" + a;\nb;', 3), ('"\\"/*";\na;\n', 2), ("/* no end\nb;", 0)):
            self.write("tree/" + LEFT, TREE[LEFT] + text)
            self.assertEqual(self.models()[0][1], 2 + lines, text)

    def test_another_folder_is_refused(self):
        done = self.run_tool("lines_of_code.py", "nowhere")
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1))
        self.assertIn("nowhere: No such file or directory, expected the folder of the program's sources", done.stderr)


if __name__ == "__main__":
    unittest.main()
