#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""No code branches on the name of a fractal or of a backend. Therefore a fractal's name may occur as a string only in
the fractal's files, in tests, and in the files listed in ALLOWED; the name of a backend that need not be built may occur
only in backends/, in documents, in tests, and in the files listed in NAME_BACKENDS."""

from __future__ import annotations

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("apps", "backends", "bench", "core", "flight", "report")
REPORT = ROOT / "report" / "out"  # output of `make report`
ALLOWED = {
    "apps/mandelbox.cpp": "the program of that name",
    "apps/mandelbulb.cpp": "the program of that name",
    "backends/reference/reference.cpp": "which estimators it has",
    "bench/result/figures.h": "the two fractals of the question that the study box-vs-bulb is about",
    "bench/measure/views.cpp": "scenes of the studies, with defaults for other fractals",
    "flight/path/measures.h": "measures of flights, with defaults for other fractals",
    "report/mandelreport/answers.py": "the two fractals that the front page compares",
    "report/mandelreport/pictures.py": "the two scenes that the report shows",
    "report/mandelreport/sections/why.py": "the two fractals of that question",
}
# Files and folders, each with the reason why it names backends.
NAME_BACKENDS = {
    "CMakePresets.json": "the option that selects them",
    "cmake/": "how each is compiled",
    "core/text/environment.h": "variables of their run-time libraries",
    "core/gpu/driver.cpp": "the two drivers for GPUs, in messages",
    "packaging/": "libraries of their drivers, and the steps that try each on a GPU",
    "report/templates/": "sentences, for readers",
    "tools/gpu_packages.txt": "packages",
    "tools/lint": "compilers of their files",
    "tools/results.txt": "what each study measures",
    "tools/setup": "packages",
}


def names() -> set[str]:
    """Returns the names and short names of all fractals, from their descriptors."""
    found = set()
    for row in (ROOT / "core" / "scene" / "fractals").glob("*.cpp"):
        found |= set(re.findall(r'\.(?:short_)?name = "(\w+)"', row.read_text(encoding="utf-8")))
    return found


def strings(code: str) -> set[str]:
    """Returns the words in quotes, and the names that follow MM_FRACTAL_."""
    return set(re.findall(r'"(\w+)"', code)) | set(re.findall(r"\bMM_FRACTAL_(\w+)", code))


def texts(*folders: str) -> dict[str, str]:
    """Returns the text of each file below the folders, without // comments, pages and output."""
    paths = (path for folder in folders for path in sorted((ROOT / folder).rglob("*")) if path.is_file())
    own = (path for path in paths if path.suffix not in {".md", ".pyc"} and not path.is_relative_to(REPORT))
    return {path.relative_to(ROOT).as_posix(): re.sub(r"//.*", "", path.read_text(encoding="utf-8", errors="replace")) for path in own}


def files_with_names() -> set[str]:
    """Returns the files that name fractals, except those of the fractals themselves."""
    return {file for file, text in texts(*FOLDERS).items() if strings(text) & names() and "/fractals/" not in file}


class FractalNames(unittest.TestCase):
    def test_rows_have_names(self) -> None:
        texts = {path.stem for path in (ROOT / "core" / "kernel" / "fractals").glob("*.h")}
        self.assertTrue(texts)
        self.assertLessEqual(texts, names())

    def test_only_listed_files_name_fractals(self) -> None:
        self.assertEqual(files_with_names(), {*ALLOWED})

    def test_the_check_finds_names(self) -> None:
        """Negative control: the check finds the names in a file of ALLOWED."""
        self.assertIn("backends/reference/reference.cpp", files_with_names())
        self.assertEqual(strings('if (name == "julia") return;'), {"julia"})
        self.assertEqual(strings("#if defined(MM_FRACTAL_julia)"), {"julia"})

    def test_only_listed_files_name_backends(self) -> None:
        known = {path.name for path in (ROOT / "backends").iterdir() if path.is_dir()} | {"hip"}
        known -= {"openmp", "reference", "program", "skeleton"}  # the first two are always built and are defaults
        self.assertGreater(len(known), 6)
        word = re.compile(rf"\b({'|'.join(sorted(known))})\b")
        top = {path.name: path.read_text(encoding="utf-8") for path in [*ROOT.glob("*.txt"), *ROOT.glob("*.json"), ROOT / "Makefile"]}
        every = top | texts(*FOLDERS, "cmake", "packaging", "tools")
        found = {file for file, text in every.items() if word.search(text) and not file.startswith("backends/")}
        allowed = tuple(NAME_BACKENDS)
        self.assertEqual([file for file in sorted(found) if not file.startswith(allowed)], [])
        self.assertEqual([entry for entry in allowed if not any(file.startswith(entry) for file in found)], [], "no longer needed")


if __name__ == "__main__":
    unittest.main()
