#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""readme_test.py BIN SOURCE: every command in the README's shell blocks works as it is written, in a folder that
contains the built programs."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BIN, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
# Commands that this test does not run, with the reasons. Their make targets must exist.
NOT_RUN = {
    "make demo": "builds, and times every backend",
    "make test": "is what runs this test",
    "make build": "the programs are built already",
    "make video-preview": "takes a minute",
    "make video": "takes an hour",
    "make bench": "takes eight minutes",
    "make explore": "builds what is built already",
    "make gpu-quarter": "takes minutes, and has a test of its parts",
    "make report": "takes minutes and installs Python packages",
}


def commands(text):
    """Returns the commands of a document's shell blocks, without comments."""
    blocks = re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)
    lines = (re.sub(r"\s+#.*", "", line) for block in blocks for line in block.splitlines())
    return [line for line in lines if line]


def run(command, folder):
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return done.returncode, (done.stdout + done.stderr)[-500:]


def failing(text, folder):
    """Returns the commands that fail, with their output, in the order of the document."""
    results = [(command, *run(command, folder)) for command in commands(text) if command not in NOT_RUN]
    return [f"{command}: exit code {code}: {said}" for command, code, said in results if code != 0]


def readme():
    with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
        return file.read()


class ReadmeTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        for name in ("mandelbulb", "mandelbox"):
            shutil.copy(os.path.join(BIN, name), self.folder)
        os.mkdir(os.path.join(self.folder, "bin"))
        for name in ("imgdiff", "bench", "flythrough"):
            shutil.copy(os.path.join(BIN, name), os.path.join(self.folder, "bin"))
        for path in glob.glob(os.path.join(SOURCE, "params*.dat")):
            shutil.copy(path, self.folder)
        for path in ("scenes", "results"):
            shutil.copytree(os.path.join(SOURCE, path), os.path.join(self.folder, path))

    def test_commands_work(self):
        self.assertEqual(failing(readme(), self.folder), [])

    def test_make_has_the_targets_that_are_not_run(self):
        for command in NOT_RUN:
            with self.subTest(command=command):
                self.assertIn(command, commands(readme()))
                self.assertEqual(run(command.replace("make", "make -n", 1), SOURCE)[0], 0)

    def test_a_command_that_fails_is_found(self):
        mutant = readme().replace("--simd-width 1 --output scalar.png", "--simd-width 1 --size 40x30 --output scalar.png")
        mutant = "".join(f"```sh\n{command}\n```\n" for command in commands(mutant)[:6])  # the last one is imgdiff
        found = failing(mutant, self.folder)
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], "^bin/imgdiff imageBulb.bmp scalar.png: exit code 1: ")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
