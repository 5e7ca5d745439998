# SPDX-License-Identifier: Apache-2.0
"""Tests tools/results.py in a synthetic repository, with a fake bench that records its calls."""
import os
import subprocess
import sys
import time
import unittest

from tool import TOOLS, ToolTest

LIST = """a.json 1 2 bench --runs {runs} --json {}
b.json 1 1 KIND=second bench --json {}
c.json 1 1 bench --json {}
"""
# A fake bench. With --version it prints its version. It records any other call and writes the requested output. A call
# fails if the recorded calls match the pattern in the file `fails`.
BENCH = """#!/bin/sh
if [ "$1" = --version ]; then echo "bench 0.1.0 ($(cat {folder}/built))"; exit; fi
echo "$KIND $*" >> {folder}/calls
if [ -e {folder}/fails ] && grep -q "$(cat {folder}/fails)" {folder}/calls; then echo broken > "$2"; exit 1; fi
for last; do :; done
cat {folder}/json > "$last"
"""
CLEAN, DIRTY = ('{"environment": {"git": {"dirty": %s}}}' % dirty for dirty in ("false", "true"))


def running(pid):
    """Returns true if the process is running. A zombie is not running."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rpartition(") ")[2][0] != "Z"
    except FileNotFoundError:
        return False


class ResultsTest(ToolTest):
    def setUp(self):
        super().setUp()
        for folder in ("sources", "bin", "output"):
            os.mkdir(self.path(folder))
        self.write("list", LIST)
        self.write("json", CLEAN)
        self.write("bin/bench", BENCH.replace("{folder}", self.folder))
        os.chmod(self.path("bin/bench"), 0o755)
        self.git("init", "-q")
        self.write("sources/file", "text")
        self.git("add", "file")
        self.git("-c", "user.name=n", "-c", "user.email=e", "commit", "-qm", "first")
        self.write("built", self.git("rev-parse", "HEAD").strip())

    def git(self, *arguments):
        return subprocess.run(["git", "-C", self.path("sources"), *arguments], capture_output=True, text=True, check=True).stdout

    def started(self, *files):
        command = [sys.executable, os.path.join(TOOLS, "results.py"), "--list", self.path("list"), "--programs", self.path("bin"), "--work",
                   self.path("work"), "--output", self.path("output"), "--sources", self.path("sources"), *files]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def results(self, *files):
        with self.started(*files) as process:
            said = process.communicate()[1]
        return process.returncode, said

    def test_the_list_of_the_project_is_read(self):
        done = self.run_tool("results.py", "none.json")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("results: none.json: not in", done.stderr)

    def test_an_exit_code_can_be_an_answer(self):
        self.write("fails", "json")
        self.write("list", "a.json 1 1 EXITS=0,1 bench --json {}\n")
        self.write("bin/bench", BENCH.replace("{folder}", self.folder).replace("echo broken", "cat {folder}/json".replace("{folder}", self.folder)))
        code, said = self.results()
        self.assertEqual(code, 0, said)
        self.assertEqual(self.read("output/a.json"), CLEAN)
        # Negative control: if the list does not allow this exit code for the command, the exit code is a failure.
        self.write("list", "b.json 1 1 bench --json {}\n")
        self.assertEqual(self.results()[0], 1)

    def test_all_are_measured_and_handed_over(self):
        code, said = self.results()
        self.assertEqual(code, 0, said)
        self.assertIn("3 files at", said)
        self.assertIn("about 4 minutes", said)
        self.assertEqual(sorted(os.listdir(self.path("output"))), ["a.json", "b.json", "c.json"])
        calls = self.read("calls").splitlines()
        self.assertTrue(calls[0].startswith(" --runs 2 --json "))
        self.assertTrue(calls[1].startswith("second --json "))

    def test_what_failed_goes_on_where_it_stopped(self):
        self.write("fails", "c.json")
        code, said = self.results()
        self.assertEqual(code, 1)
        self.assertIn("results: c.json: ", said.splitlines()[-1])
        self.assertEqual(os.listdir(self.path("output")), [], "nothing is handed over before all are there")
        os.remove(self.path("fails"))
        code, said = self.results()
        self.assertEqual(code, 0, said)
        self.assertIn("2 of them are finished", said)
        self.assertEqual(len(self.read("calls").splitlines()), 4)  # for a, b, c, and again for c

    def test_what_is_stopped_leaves_nothing_running(self):
        self.write("bin/bench", BENCH.replace("{folder}", self.folder).replace("for last", "sleep 600 & echo $! > "
                                                                               f"{self.path('sleeper')}; wait\nfor last"))
        with self.started() as process:
            while not os.path.exists(self.path("sleeper")) or not self.read("sleeper"):
                time.sleep(0.01)
            process.terminate()
            said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130)
        self.assertEqual(said.splitlines()[-1], "results: stopped; the same command resumes")
        for _ in range(1000):  # the process that adopts orphans may need a moment
            if not running(int(self.read("sleeper"))):
                return
            time.sleep(0.01)
        self.fail("what it had started goes on")

    def test_another_revision_begins_anew(self):
        self.results("a.json")
        self.git("-c", "user.name=n", "-c", "user.email=e", "commit", "-q", "--allow-empty", "-m", "second")
        code, said = self.results("a.json")
        self.assertEqual(code, 2)
        self.assertIn("make build", said)
        self.write("built", self.git("rev-parse", "HEAD").strip())
        self.assertEqual(self.results("a.json")[0], 0)
        self.assertEqual(len(self.read("calls").splitlines()), 2)

    def test_uncommitted_sources_are_refused(self):
        self.write("sources/file", "changed")
        code, said = self.results()
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("commit first", said)

    def test_a_program_of_uncommitted_sources_is_found_by_its_result(self):
        self.write("json", DIRTY)
        self.assertEqual(self.results()[0], 1)
        self.assertEqual(os.listdir(self.path("output")), [])


if __name__ == "__main__":
    unittest.main()
