# SPDX-License-Identifier: Apache-2.0
"""The base class of tests that run a script of the folder tools in an empty folder."""
import os
import subprocess
import sys
import tempfile
import unittest

TOOLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")
sys.path.insert(0, TOOLS)


class ToolTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text, encoding="utf-8"):
        """Writes text to a file, with its line ends unchanged."""
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding=encoding, newline="") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def run_tool(self, name, *arguments):
        """Runs the script `name` of tools/ in the test's folder."""
        return subprocess.run([sys.executable, os.path.join(TOOLS, name), *arguments], cwd=self.folder, capture_output=True,
                              text=True, check=False)
