#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""demo_test.py BIN SOURCE: tools/demo makes one page that needs no network, with a still, a film, the viewer, and the
pictures of every backend."""
import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
SIDE = 48
REMOTE = re.compile(r"""(?:src|href|action)\s*=\s*["']?\s*(?:https?:)?//|@import|(?<!\w)url\(\s*["']?(?!data:)""", re.I)


def run(*command, **environment):
    return subprocess.run(
        command, cwd=SOURCE, capture_output=True, text=True, check=False, env={**os.environ, **environment}
    )


def text_of(path):
    return Path(path).read_text(encoding="utf-8") if os.path.exists(path) else ""


class DemoTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.page = os.path.join(cls.folder, "new", "index.html")
        # Makes the film smaller, because rendering it takes most of the time.
        programs = os.path.join(cls.folder, "bin")
        os.mkdir(programs)
        for name in os.listdir(BIN):
            os.symlink(os.path.join(BIN, name), os.path.join(programs, name))
        Path(programs, "flythrough").unlink()
        Path(programs, "flythrough").write_text(f'#!/bin/bash\nexec {BIN}/flythrough "${{@/960x540/96x54}}"\n')
        Path(programs, "flythrough").chmod(0o755)
        cls.done = run("tools/demo", programs, cls.page, "--side", str(SIDE))
        cls.text = text_of(cls.page)
        cls.small = os.path.join(cls.folder, "small")  # output of demo, without a still and a film
        run(os.path.join(BIN, "demo"), "--folder", cls.small, "--side", "16")
        devices = run(os.path.join(BIN, "render"), "--list-devices").stdout
        cls.backends = {line.split()[0] for line in devices.splitlines()}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def made(self, change):
        """Makes the page after `change` has changed the content of demo.json. Returns the process and the page."""
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        shutil.copytree(self.small, folder, dirs_exist_ok=True)
        table = json.loads(text_of(folder / "demo.json"))
        change(table)
        (folder / "demo.json").write_text(json.dumps(table), encoding="utf-8")
        page = folder / "page.html"
        done = run("python3", "-m", "mandelreport.demo", "--folder", folder, "--programs", BIN, "--output", page,
                   PYTHONPATH="report", PYTHONDONTWRITEBYTECODE="1")
        return done, text_of(page)

    def page_of(self, change):
        done, text = self.made(change)
        self.assertEqual(done.returncode, 0, done.stderr)
        return text

    def test_it_succeeds_and_ends_with_the_path(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(self.done.stdout.splitlines()[-1], self.page)
        self.assertEqual(os.listdir(os.path.dirname(self.page)), ["index.html"])

    def test_notices_appear_once(self):
        lines = [line for line in self.done.stderr.splitlines() if line]
        self.assertEqual(len(lines), len(set(lines)), self.done.stderr)

    def test_every_backend_is_there(self):
        for backend in self.backends:
            self.assertRegex(self.text, rf">{backend}(?:-scalar)?[:,<]", backend)

    def test_speed_ups_are_over_the_reference(self):
        rows = json.loads(text_of(Path(self.small, "demo.json")))["rows"]
        self.assertEqual([row for row in rows if row["drawn"] and not row["speed_up"] > 0], [])

    def test_the_pictures_are_pictures(self):
        found = re.findall(r"data:image/png;base64,([A-Za-z0-9+/=]+)", self.text)
        self.assertGreater(len(found), 4)
        for data in found:
            png = base64.b64decode(data)
            self.assertEqual((png[:8], struct.unpack(">II", png[16:24])), (b"\x89PNG\r\n\x1a\n", (SIDE, SIDE)))
        self.assertEqual(len(found), len(set(found)), "a picture is stored twice")

    def test_it_has_a_still_a_film_and_the_viewer(self):
        still = re.search(r"data:image/jpeg;base64,([A-Za-z0-9+/=]+)", self.text)
        self.assertEqual(base64.b64decode(still[1])[:2], b"\xff\xd8")
        film = re.search(r"data:video/mp4;base64,([A-Za-z0-9+/=]+)", self.text)
        self.assertEqual(base64.b64decode(film[1])[4:8], b"ftyp")
        self.assertIn('id="viewer-canvas"', self.text)
        self.assertIn("#version 300 es", self.text)
        self.assertNotRegex(self.text, "<strong>No (still|film)")

    def test_its_head_counts_backends_with_the_same_bits(self):
        def spoil(table):
            row = next(row for row in table["rows"] if row["backend"] == "openmp" and row["simd_width"] != 1)
            row.update(said="OTHER BITS", fine=False, wall_seconds=0)

        counts = []
        for change in (lambda table: None, spoil):
            text = self.page_of(change)
            head = re.search(r"(\d+) backends gave the same bits\s+\((.*?)\)", text)
            self.assertEqual(int(head[1]), len(head[2].split(", ")))
            counts.append(int(head[1]))
            self.assertIn("times as fast as the serial reference", text)
        self.assertGreater(counts[0], 1)
        self.assertEqual(counts[1], counts[0] - 1)

    def test_a_page_without_a_still_and_a_film_names_them(self):
        text = self.page_of(lambda table: None)
        for part in ("still", "film"):
            self.assertIn(f"<strong>No {part}:</strong>", text)
        self.assertNotRegex(text, "data:(image/jpeg|video)")

    def test_the_slider_begins_with_two_backends_and_the_same_picture(self):
        chosen = re.findall(r'<option value="([\w-]+)" selected>(.*?)</option>', self.text)
        self.assertEqual(len(chosen), 4)
        for (left, one), (right, other) in (chosen[:2], chosen[2:]):
            self.assertEqual(left, right)
            self.assertNotEqual(one, other)
            for name in (one, other):
                self.assertRegex(name, r"^(?!reference)[\w-]+, double, exact$")
        self.assertRegex(self.text, r'<option value="[\w-]+">openmp, float, fast</option>')

    def test_there_is_a_button_for_every_view(self):
        names = [path.name.split(".")[0].capitalize() for path in Path(SOURCE, "scenes").glob("*.*.dat")]
        buttons = re.findall(r'data-view="\d+">(\w+)<', self.text)
        self.assertEqual(sorted(buttons), sorted(names))
        self.assertEqual(buttons[0], "Reef")

    def test_a_backend_for_gpus_on_the_cpu_has_a_hatched_bar(self):
        for is_gpu in (False, True):
            def rename(table):
                for row in table["rows"]:
                    hosted = row["backend"] == "openmp" and row["simd_width"] != 1
                    row.update(backend="openacc" if hosted else "openmp", is_gpu=is_gpu)
                    row["device"] = "host, one thread" if hosted else table["cpu"]

            text = self.page_of(rename)
            bars = re.findall(r'<span class="name">openacc(.*?)</span><span><span class="bar(.*?)"', text)
            wanted = ("", "") if is_gpu else (" (host, one thread)", " hatched")
            self.assertEqual(set(bars), {wanted})

    def test_absent_backends_are_in_one_line(self):
        def remove(table):
            for row in table["rows"]:
                if row["backend"] in ("openmp", "reference"):
                    continue
                row.update(drawn=False, picture="", said="absent today")
            for name in ("first", "second"):
                table["rows"].append(table["rows"][0] | {"backend": name, "drawn": False, "picture": "", "said": "not built"})

        text = self.page_of(remove)
        self.assertEqual(text.count("not built"), 1)
        self.assertIn("<code>first</code>, <code>second</code> (not built)", text)

    def test_it_needs_no_network(self):
        self.assertIn("default-src 'none'", self.text)
        self.assertIsNone(REMOTE.search(self.text))

    def test_a_remote_picture_is_found(self):
        self.assertIsNotNone(REMOTE.search(self.text.replace('src="data:image', 'src="https://example.org/', 1)))

    def test_a_failed_row_is_shown_as_failed(self):
        def fail(table):
            row = next(row for row in table["rows"] if row["backend"] == "openmp")
            row.update(fine=False, said="OTHER BITS")

        text = self.page_of(fail)
        self.assertRegex(text, r"<strong>FAILED:</strong> \w+, openmp, double, exact: OTHER BITS")
        self.assertNotIn("<strong>FAILED", self.text)

    def test_half_and_hostile_tables_are_one_line(self):
        for change in (lambda table: table.update(rows=[]), lambda table: table["rows"][0].pop("said"),
                       lambda table: table["rows"][0].update(picture="none.png"),
                       lambda table: table["rows"][0].update(picture="../../../../etc/passwd")):
            done, text = self.made(change)
            self.assertEqual((done.returncode, text, done.stderr.count("\n")), (2, "", 1), done.stderr)

    def test_pictures_that_cannot_be_written_cost_no_table(self):
        done = run("bash", "-c", f"ulimit -f 1; exec '{BIN}/demo' --side 64 --folder '{self.folder}/full'", MANDELMARCH_BACKENDS="openmp")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, "double +exact openmp +0 same bits +[0-9.]+ ")
        self.assertRegex(done.stderr, r"\ndemo: .*/full/.*: cannot write it: File too large\n$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
