# SPDX-License-Identifier: Apache-2.0
"""Runs the report's program on synthetic result files and checks the page. On broken input, each important check must
fail."""

from __future__ import annotations

import base64
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import made  # noqa: E402
import made_programs  # noqa: E402
from mandelreport.page import APPENDIX, MAIN  # noqa: E402

# Pictures without a description, and whatever a page loads from elsewhere.
FAULT = re.compile(r'<img(?![^>]*alt="[^"]{10})|<\w[^>]* (?:src|srcset|poster|data)="(?!data:)|<link[^>]*href="(?!data:)|@import|url\((?!data:)')


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def make(self, files: dict[str, object], programs: str = "none", seed: str = "0", output: str = "out", results: str = "results") -> subprocess.CompletedProcess[str]:
        made.write(self.folder / results, files)
        made_programs.programs(self.folder / "none", ["bench"])  # no other program
        folders = {"--results": results, "--programs": programs, "--work": "work", "--output": output}
        return subprocess.run(
            [sys.executable, "-m", "mandelreport", "--no-pdf", *(word for name, folder in folders.items() for word in (name, self.folder / folder))],
            capture_output=True,
            text=True,
            check=False,
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT / "report"), "PYTHONHASHSEED": seed},
        )

    def page(self, output: str = "out") -> str:
        return (self.folder / output / "report.html").read_text(encoding="utf-8")

    def refused(self, files: dict[str, object], *words: str) -> None:
        run = self.make(files)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertFalse((self.folder / "out" / "report.html").exists())

    def test_whole_page(self) -> None:
        made_programs.programs(self.folder / "bin")
        run = self.make(made.everything(), "bin")
        self.assertEqual(run.returncode, 0, run.stderr)
        page = self.page()
        self.assertNotRegex(page, FAULT)
        self.assertLess(len(page), 15 * 2**20)
        self.assertEqual(
            re.findall(r'<section id="(\w+)"', page),
            ["front", *(name for name, *_ in [*MAIN, *APPENDIX])],
        )
        # The page has values from the files: 1.17 degrees, 0.25 s per frame, the revision, the titles of backends.
        for text in ("1.17 deg", "0.25", made.bench()["environment"]["git"]["revision"][:7]):
            self.assertIn(f">{text}", page)
        self.assertIn("through OpenMP and Vulkan,", page)
        self.assertIn(">0.12 – 0.99<", page)  # range over two sets of random scenes
        # The page says how each backend of the results distributes its work.
        self.assertRegex(page, r"<td>openmp</td><td>each thread takes tiles of 16 x 16 pixels")
        # A CSV file of all results is beside the page and inside it.
        table = "file,backend,kernel_s\nbench.json,openmp,0.1\n"
        self.assertEqual((self.folder / "out" / "timings.csv").read_text(encoding="utf-8"), table)
        self.assertIn(f'download="timings.csv" href="data:text/csv;base64,{base64.b64encode(table.encode()).decode()}"', page)
        self.numbered(page)
        self.assertRegex(page, r"float for double</td><td.*?>[\d,.]+</td><td.*?>[\d.]+</td><td.*?>\[[\d.]+, [\d.]+\]</td>")
        # Equal pictures are stored once. Therefore each fractal has two pictures, a correct and a wrong one.
        self.assertEqual(len(re.findall(r'id="pic-', page)), 4)
        self.assertIn("same bits", page)
        self.assertIn("1 px, 1 visibly, max 10", page)
        self.assertIn("backend opencl: not here", page)
        # The same files give the same page, byte for byte, in another folder and with another order of Python's sets.
        again = self.make(made.everything(), "bin", seed="1", output="again", results="elsewhere")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(page, self.page("again"))
        # Negative control: if a number in a file is changed, the page has the other number.
        changed = made.bench()
        changed["rows"][0]["figures"]["kernel_seconds"]["median"] = 0.7654
        self.make({"bench.json": changed}, output="changed", results="changed")
        self.assertIn(">765 [", self.page("changed"))
        self.assertNotIn(">765 [", page)

    def numbered(self, page: str) -> None:
        """Checks that figures and tables have consecutive numbers, each with its caption."""
        for kind in ("figure", "table"):
            numbers = [int(number) for number in re.findall(rf'id="{kind}-(\d+)"', page)]
            self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
            self.assertGreater(len(numbers), 10)
            self.assertEqual(re.findall(rf"<b>{kind.capitalize()} (\d+)\.</b>", page), list(map(str, numbers)))

    def test_a_device_that_fails_is_named_and_all_others_are_there(self) -> None:
        made_programs.programs(self.folder / "bin")
        (self.folder / "results").mkdir()
        with mock.patch.dict(os.environ, MADE_FAILURE="vulkan"):
            run = self.make({}, "bin")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("report: mandelbulb, vulkan, double, exact: render: backend vulkan: device 0: it crashed", run.stderr)
        self.assertIn("device 0: it crashed", self.page())
        self.assertIn("same bits", self.page())

    def test_faults_are_found(self) -> None:
        self.assertNotRegex('<img alt="a picture of it" src="data:,">', FAULT)
        for broken in ('<img src="data:,">', '<img alt="a picture of it" src="http://x/y.png">', '<link href="a.css">', "url(a.png)"):
            self.assertRegex(broken, FAULT)

    def test_nothing_there(self) -> None:
        (self.folder / "results").mkdir()
        run = self.make({})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertGreater(self.page().count("No data yet:"), 15)
        self.assertIn("make bench", self.page())
        self.assertNotRegex(self.page(), FAULT)

    def test_bad_files(self) -> None:
        # Files stay in the folder during the test and are read in the order of their names. The first broken file is
        # reported. Therefore each file below that is broken must come before the broken files that are already there.
        self.refused({"random.json": made.random_scenes() | {"refused": 1}}, "bench: it is refused")
        self.refused({"bench.json": '{"schema": "mandelmarch-bench", "ver'}, "bench.json", "expected JSON")
        self.refused({"bench.json": "[" * 100000}, "bench.json", "nested too deep")
        self.refused({"bench.json": made.bench(), "map.json": made.stored("map_bulb.json") | {"turn": [1.0]}}, "map.json", "frames")
        self.refused({"map.json": {"format": "mandelmarch flight map 1"}}, "map.json", "'x' is missing")
        self.refused({"map.json": made.stored("map_bulb.json"), "flight.json": made.audit() | {"schema": 0}}, "flight.json", "schema 0")
        self.refused({"flight.json": made.audit() | {"rows": [{}]}}, "flight.json", "'name' is missing")
        self.refused({"flight.json": made.audit(), "film.json": made.film() | {"version": 9}}, "film.json", "version 9")
        film = made.film()
        del film["device"]
        self.refused({"film.json": film}, "film.json", "device")

    def test_no_folder(self) -> None:
        run = self.make({}, results="nowhere")
        self.assertEqual((run.returncode, len(run.stderr.strip().splitlines())), (2, 1), run.stderr)

    def test_old_report_stays(self) -> None:
        (self.folder / "out").mkdir()
        (self.folder / "out" / "report.html").write_text("old", encoding="utf-8")
        self.assertEqual(self.make({"bench.json": "{"}).returncode, 2)
        self.assertEqual(self.page(), "old")
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["report.html"])

    def test_other_json_is_left_out(self) -> None:
        run = self.make({"other.json": {"a": 1}, "list.json": [1, 2]})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr.count("left out"), 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
