#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""No code branches on a fractal's name. Therefore a fractal's name may occur as a string only in the fractal's files,
in tests, and in the files listed in ALLOWED."""

from __future__ import annotations

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("apps", "backends", "bench", "core", "flight", "instruments", "report")
REPORT = ROOT / "report" / "out"  # output of `make report`
ENDINGS = {".cpp", ".h", ".in", ".cl", ".comp", ".js", ".py"}
ALLOWED = {
    "apps/mandelbox.cpp": "the program of that name",
    "apps/mandelbulb.cpp": "the program of that name",
    "backends/reference/reference.cpp": "which estimators it has",
    "bench/result/figures.h": "the two fractals of the question that the study box-vs-bulb is about",
    "bench/study/views.cpp": "scenes of the studies, with defaults for other fractals",
    "flight/path/measures.cpp": "measures of flights, with defaults for other fractals",
    "report/mandelreport/answers.py": "the two fractals that the front page compares",
    "report/mandelreport/pictures.py": "the two scenes that the report shows",
    "report/mandelreport/sections/why.py": "the two fractals of that question",
    "report/mandelreport/viewer_check.py": "odd parameters, which the viewer is tried at",
}


def names() -> set[str]:
    """Returns the names and short names of all fractals, from their descriptors."""
    found = set()
    for row in (ROOT / "core" / "scene" / "fractals").glob("*.cpp"):
        found |= set(re.findall(r'\.(?:short_)?name = "(\w+)"', row.read_text(encoding="utf-8")))
    return found


def strings(text: str) -> set[str]:
    """Returns the words in quotes outside comments, and the names that follow MM_FRACTAL_."""
    code = re.sub(r"//.*", "", text)
    return set(re.findall(r'"(\w+)"', code)) | set(re.findall(r"\bMM_FRACTAL_(\w+)", code))


def files_with_names() -> dict[str, set[str]]:
    known = names()
    found = {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in ENDINGS or path.parent.name == "fractals" or path.is_relative_to(REPORT):
                continue
            if here := strings(path.read_text(encoding="utf-8")) & known:
                found[path.relative_to(ROOT).as_posix()] = here
    return found


class FractalNames(unittest.TestCase):
    def test_rows_have_names(self) -> None:
        texts = {path.stem for path in (ROOT / "core" / "kernel" / "fractals").glob("*.h")}
        self.assertTrue(texts)
        self.assertLessEqual(texts, names())

    def test_only_listed_files_name_fractals(self) -> None:
        self.assertEqual({file: here for file, here in files_with_names().items() if file not in ALLOWED}, {})

    def test_the_check_finds_names(self) -> None:
        """Negative control: the check finds the names in a file of ALLOWED."""
        self.assertIn("backends/reference/reference.cpp", files_with_names())
        self.assertEqual(strings('if (name == "julia") return;  // not "bulb"'), {"julia"})
        self.assertEqual(strings("#if defined(MM_FRACTAL_julia)"), {"julia"})


if __name__ == "__main__":
    unittest.main()
