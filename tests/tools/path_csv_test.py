#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""path_csv_test.py: a path converted to a table and back is unchanged."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

TOOLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")


def frame(number):
    return {"location": [1.5 + number, -0.25, 0.125], "look_at": [0.7 + number, 0.1, 0.5], "up": [0.1, 0.9, 0.2],
            "field_of_view": 1.25, "brightness": 1.5 + number}


PATH = {"format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": 30,
        "scene": {"detail": "by size", "shape": [0, 4, 8]}, "frames": [frame(n) for n in range(4)]}


class TableTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.write("path.json", json.dumps(PATH))

    def name(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text, encoding="utf-8"):
        with open(self.name(name), "w", encoding=encoding, newline="") as file:
            file.write(text)

    def read(self, name):
        with open(self.name(name), encoding="utf-8") as file:
            return file.read()

    def run_tool(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(TOOLS, "path_csv.py"), *arguments], cwd=self.folder,
                              capture_output=True, text=True)

    def test_a_table_and_back(self):
        self.assertEqual(self.run_tool("export", "path.json", "path.csv").returncode, 0)
        self.assertEqual(self.read("path.csv").splitlines()[1], "0,1.5,-0.25,0.125,0.7,0.1,0.5,0.1,0.9,0.2,1.25")
        self.assertEqual(self.run_tool("import", "path.json", "path.csv", "new.json").returncode, 0)
        self.assertEqual(json.loads(self.read("new.json")), PATH)

    def test_a_changed_table_changes_its_frames_alone(self):
        self.run_tool("export", "path.json", "path.csv")
        self.write("path.csv", self.read("path.csv").replace("2,3.5,", "2,9.5,"))
        self.run_tool("import", "path.json", "path.csv", "new.json")
        new = json.loads(self.read("new.json"))
        self.assertEqual([n for n in range(4) if new["frames"][n] != PATH["frames"][n]], [2])
        self.assertEqual(new["frames"][2]["location"][0], 9.5)

    def test_a_shape_that_changes_is_in_the_table(self):
        frames = [{**frame(n), "shape": [0, 4, 8 - n]} for n in range(3)]
        self.write("path.json", json.dumps({**PATH, "frames": frames}))
        self.run_tool("export", "path.json", "path.csv")
        table = self.read("path.csv")
        self.assertTrue(table.splitlines()[0].endswith(",field_of_view,shape_1,shape_2,shape_3"))
        self.write("path.csv", table.replace(",0,4,7\n", ",0,4,7.5\n"))
        self.run_tool("import", "path.json", "path.csv", "new.json")
        self.assertEqual([f["shape"] for f in json.loads(self.read("new.json"))["frames"]], [[0, 4, 8], [0, 4, 7.5], [0, 4, 6]])

    def test_a_table_of_a_spreadsheet_is_the_same_path(self):
        self.run_tool("export", "path.json", "path.csv")
        good = self.read("path.csv")
        head, *lines = good.splitlines()
        semicolons = good.replace(",", ";")
        for what, text in (("lines in another order", "\n".join([head, *reversed(lines)]) + "\n"),
                           ("a byte-order mark", "\ufeff" + good), ("an empty line at the end", good + "\n"),
                           ("commas alone in a line", good + "," * 10 + "\n"), ("an empty line before", "\n" + good),
                           ("semicolons", semicolons), ("decimal commas", semicolons.replace(".", ",")),
                           ("UTF-16", good.replace(",", "\t")), ("tabs", good.replace(",", "\t")),
                           ("ends of lines of Windows", good.replace("\n", "\r\n")),
                           ("quotes", '"' + head.replace(",", '","') + '"\n' + "\n".join(lines)),
                           ("all of Excel", "\ufeff" + semicolons.replace(".", ",").replace("\n", "\r\n") + "\r\n")):
            self.write("path.csv", text, "utf-16" if what == "UTF-16" else "utf-8")
            done = self.run_tool("import", "path.json", "path.csv", "new.json")
            self.assertEqual((done.returncode, done.stderr), (0, ""), what)
            self.assertEqual(json.loads(self.read("new.json")), PATH, what)

    def test_frames_that_are_left_out_are_no_more(self):
        self.run_tool("export", "path.json", "path.csv")
        lines = self.read("path.csv").splitlines()
        self.write("path.csv", "\n".join([lines[0], lines[4], lines[2]]) + "\n")
        self.run_tool("import", "path.json", "path.csv", "new.json")
        self.assertEqual(json.loads(self.read("new.json"))["frames"], [PATH["frames"][1], PATH["frames"][3]])

    def test_bad_tables_are_one_line(self):
        self.run_tool("export", "path.json", "path.csv")
        good = self.read("path.csv")
        for bad, said in ((good.replace("\n2,", "\n1,"), "path.csv:4: frame 1 is there twice"),
                          (good.replace("\n2,", "\n1.5,"), "path.csv:4: the frame is 1.5"),
                          (good.replace("\n2,", "\n,"), "path.csv:4:"),
                          (good.replace("frame,", "picture,"), "path.csv:1:"), (good.replace("3.5", "nan"), "path.csv:4:"),
                          (good.replace("3.5", "x"), "path.csv:4:"), ("\n".join(good.splitlines()[:1]), "no frames")):
            self.write("path.csv", bad)
            done = self.run_tool("import", "path.json", "path.csv", "new.json")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.name("new.json")))
        self.assertEqual(self.run_tool("export", "missing.json", "x.csv").returncode, 2)


if __name__ == "__main__":
    unittest.main()
