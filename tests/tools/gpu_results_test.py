# SPDX-License-Identifier: Apache-2.0
"""Tests tools/gpu_results.py with archives that are half, hostile or odd."""
import gzip
import io
import json
import os
import tarfile
import unittest

from tool import ToolTest

ROW = {"fractal": "mandelbulb", "precision": "float", "mode": "fast", "backend": "cuda", "samples": [{"kernel": 0.001}, {"kernel": 0.001}],
       "verification": {"passed": True}, "setting": {"width": 64, "height": 48}}
GOOD = {"results/summary.txt": "cuda       passed      1 s  same bits in 6 pictures\n", "results/nvidia-smi.txt": "Product Name : NVIDIA H100\n",
        "results/t-cuda.json": json.dumps({"rows": [ROW]}), "results/seen-cuda.json": '{"seconds": {"context": 0.25, "wall": 0.5}}', "results/backends": "cuda"}


def rows(**changes):
    return {"results/t-cuda.json": json.dumps({"rows": [ROW | changes]})}


class GpuResultsTest(ToolTest):
    def read_archive(self, files, *members):
        """Makes an archive of text files and other members, and reads it into the folder `into`."""
        with tarfile.open(self.path("a.tgz"), "w:gz") as tar:
            for name, text in files.items():
                member = tarfile.TarInfo(name)
                member.size = len(text.encode())
                tar.addfile(member, io.BytesIO(text.encode()))
            for member in members:
                tar.addfile(member)
        return self.read_file()

    def read_file(self):
        os.makedirs(self.path("into"), exist_ok=True)
        return self.run_tool("gpu_results.py", "a.tgz", "into")

    def refused(self, done, what):
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), f"{what}: {done.stderr[-500:]}")
        self.assertTrue(done.stderr.isascii() and done.stderr.strip().isprintable(), done.stderr)
        self.assertEqual(os.listdir(self.path("into")), [], what)

    def test_a_good_archive_is_a_page(self):
        done = self.read_archive(GOOD | {"results/README.md/x": "a folder", "results/bits/t-x.json": "{"})
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.read("into/NVIDIA-H100/README.md")
        self.assertIn("| mandelbulb float fast | 1 |", page)
        self.assertIn("2 pictures of 64 x 48", page)
        self.assertIn("| first picture | 750 |", page)
        self.assertEqual(sorted(os.listdir(self.path("into/NVIDIA-H100"))), ["README.md", "logs.tar.xz", "t-cuda.json"])
        with tarfile.open(self.path("into/NVIDIA-H100/logs.tar.xz")) as tar:
            self.assertEqual(tar.getnames(), ["README.md/x", "backends", "bits/t-x.json", "nvidia-smi.txt", "seen-cuda.json", "summary.txt"])

    def test_half_archives_are_refused_in_one_line(self):
        for what, change in {
                "no JSON": {"results/t-cuda.json": "{"}, "another form": {"results/t-cuda.json": "[]"},
                "no rows": {"results/t-cuda.json": "{}"}, "deep": {"results/t-cuda.json": "[" * 100000},
                "no time": rows(samples=[{"kernel": None}]), "a text": rows(samples=[{"kernel": "x"}]),
                "infinite": rows(samples=[{"kernel": 1e999}]), "no setting": rows(setting=None),
                "a list": rows(fractal=["\x1b[31m"]), "digits": {"results/t-cuda.json": '{"rows": ' + "9" * 5000 + "}"},
                "no seconds": {"results/seen-cuda.json": "{}"}, "no product name": {"results/nvidia-smi.txt": "    Product Name :\n    Brand : x\n"},
                "empty stats": {"results/nvidia-smi.txt": "", "results/seen-cuda.json": ""},
                "other stats": {"results/nvidia-smi.txt": "", "results/seen-cuda.json": '{"device": []}'}}.items():
            self.refused(self.read_archive(GOOD | change), what)
        self.refused(self.read_archive({"results/summary.txt/x": ""}), "a summary that is a folder")

    def test_of_other_members_nothing_is_written(self):
        link = tarfile.TarInfo("results/t-link.json")
        link.type, link.linkname = tarfile.SYMTYPE, self.path("a.tgz")
        self.assertEqual(self.read_archive(GOOD | {"../out": "", self.path("out"): "", "results/../../t-out.json": "{"}, link).returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.tgz", "into"])
        self.assertEqual(sorted(os.listdir(self.path("into/NVIDIA-H100"))), ["README.md", "logs.tar.xz", "t-cuda.json"])

    def test_other_files_are_refused(self):
        for data in (b"", b"\x1f\x8b\x08\x00", gzip.compress(b"x" * 600), gzip.compress(b"x")[:-9] + b"123456789"):
            with open(self.path("a.tgz"), "wb") as file:
                file.write(data)
            self.refused(self.read_file(), data)

    def test_a_name_of_any_letters_is_a_folder(self):
        for name, folder in (("\u663e\u5361" * 100, ("\u663e\u5361" * 100)[:60]), ("\x1b[31m///", "31m"), ("//", "unnamed")):
            done = self.read_archive(GOOD | {"results/nvidia-smi.txt": f"Product Name : {name}\n"})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("\x1b", done.stdout)
            self.assertTrue(os.path.exists(self.path(f"into/{folder}/README.md")), os.listdir(self.path("into")))


if __name__ == "__main__":
    unittest.main()
