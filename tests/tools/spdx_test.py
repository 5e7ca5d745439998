#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""spdx_test.py: tools/spdx adds the licence line once, at a place where it has no effect, and detects files without
it."""
import os
import subprocess
import sys
import tempfile
import unittest

SPDX = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "spdx")
LINE = "SPDX-License-Identifier: Apache-2.0"
# name: (contents before, contents after)
FILES = {
    "a.cpp": ("// What it is.\nint a;\n", f"// {LINE}\n// What it is.\nint a;\n"),
    "a.cpp.in": ("int a = @A@;\n", f"// {LINE}\nint a = @A@;\n"),
    "a.comp": ("#version 460\n", f"// {LINE}\n#version 460\n"),
    "a.css": ("a {}\n", f"/* {LINE} */\na {{}}\n"),
    "a.html.j2": ("<!doctype html>\n", f"{{# {LINE} -#}}\n<!doctype html>\n"),
    "a.py": ('#!/usr/bin/env python3\n"""What it is."""\n', f'#!/usr/bin/env python3\n# {LINE}\n"""What it is."""\n'),
    "tool": ("#!/bin/sh\ntrue\n", f"#!/bin/sh\n# {LINE}\ntrue\n"),
    "CMakeLists.txt": ("project(a)\n", f"# {LINE}\nproject(a)\n"),
    "empty.py": ("", f"# {LINE}\n"),
    "words.txt": ("no source\n", "no source\n"),
    "data.json.in": ("{}\n", "{}\n"),
}


class SpdxTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        for name, (before, _) in FILES.items():
            self.write(name, before)
        subprocess.run(["git", "-C", self.folder, "init", "-q"], check=True)
        subprocess.run(["git", "-C", self.folder, "add", "."], check=True)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def spdx(self, *options):
        done = subprocess.run([sys.executable, SPDX, *options, self.folder], capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_every_source_gets_its_line_once(self):
        for _ in range(2):
            self.assertEqual(self.spdx(), (0, ""))
            for name, (_, after) in FILES.items():
                with open(os.path.join(self.folder, name), encoding="utf-8") as file:
                    self.assertEqual(file.read(), after, name)

    def test_a_file_without_it_is_found(self):
        self.spdx()
        self.assertEqual(self.spdx("--check"), (0, ""))
        self.write("tool", FILES["tool"][0])
        code, said = self.spdx("--check")
        self.assertEqual(code, 1)
        self.assertRegex(said, r"\Atool: no line .*\n\Z")

    def test_a_folder_without_git_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, SPDX, "--check", folder], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (77, 1))


if __name__ == "__main__":
    unittest.main()
