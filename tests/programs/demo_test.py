#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""demo_test.py BIN SOURCE: tools/demo makes one page that needs no network, with the pictures of every backend."""
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
import zlib
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


def png_size(data):
    """Returns the width and height of a PNG. Fails if its image data cannot be decompressed."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("no PNG")
    at, packed = 8, b""
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        if data[at + 4 : at + 8] == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += 12 + size
    zlib.decompress(packed)
    return struct.unpack(">II", data[16:24])


class DemoTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.page = os.path.join(cls.folder, "new", "index.html")
        cls.done = run("tools/demo", BIN, cls.page, "--side", str(SIDE))
        cls.text = text_of(cls.page)
        devices = run(os.path.join(BIN, "render"), "--list-devices").stdout
        cls.backends = {line.split()[0] for line in devices.splitlines()}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def page_of(self, change):
        """Returns the page that is made after `change` has changed the content of demo.json."""
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        run(os.path.join(BIN, "demo"), "--folder", folder, "--side", "16")
        table = json.loads(text_of(folder / "demo.json"))
        change(table)
        (folder / "demo.json").write_text(json.dumps(table), encoding="utf-8")
        page = folder / "page.html"
        done = run("python3", "-m", "mandelreport.demo", "--folder", folder, "--programs", BIN, "--output", page,
                   PYTHONPATH="report", PYTHONDONTWRITEBYTECODE="1")
        return done, text_of(page)

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

    def test_the_pictures_are_pictures(self):
        found = re.findall(r"data:image/png;base64,([A-Za-z0-9+/=]+)", self.text)
        self.assertGreater(len(found), 4)
        for data in found:
            self.assertEqual(png_size(base64.b64decode(data)), (SIDE, SIDE))
        self.assertEqual(len(found), len(set(found)), "a picture is stored twice")

    def test_it_has_a_film_and_the_viewer(self):
        film = re.search(r"data:video/mp4;base64,([A-Za-z0-9+/=]+)", self.text)
        self.assertEqual(base64.b64decode(film[1])[4:8], b"ftyp")
        self.assertIn('id="viewer-canvas"', self.text)
        self.assertIn("#version 300 es", self.text)

    def test_it_needs_no_network(self):
        self.assertIn("default-src 'none'", self.text)
        self.assertIsNone(REMOTE.search(self.text))

    def test_a_remote_picture_is_found(self):
        self.assertIsNotNone(REMOTE.search(self.text.replace('src="data:image', 'src="https://example.org/', 1)))

    def test_a_failed_row_is_shown_as_failed(self):
        def fail(table):
            row = next(row for row in table["rows"] if row["backend"] == "openmp")
            row.update(fine=False, said="OTHER BITS")

        done, text = self.page_of(fail)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(text, r"<strong>FAILED:</strong> \w+, openmp, double, exact: OTHER BITS")
        self.assertNotIn("<strong>FAILED", self.text)

    def test_another_schema_is_one_line(self):
        done, text = self.page_of(lambda table: table.update(schema=2))
        self.assertEqual((done.returncode, text, done.stderr.count("\n")), (2, "", 1), done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
