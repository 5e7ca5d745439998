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
ENDINGS = {".cpp", ".h", ".in", ".cl", ".comp", ".js", ".py"}
ALLOWED = {
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
    "bench/command/scene_commands.cpp": "an example in --help",
    "bench/measure/options.cpp": "an example in --help",
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


def strings(text: str) -> set[str]:
    """Returns the words in quotes outside comments, and the names that follow MM_FRACTAL_."""
    code = re.sub(r"//.*", "", text)
    return set(re.findall(r'"(\w+)"', code)) | set(re.findall(r"\bMM_FRACTAL_(\w+)", code))


def files_below(folder: str) -> list[Path]:
    """Returns the files of a folder and its folders, or only of the top level, without pages, backends and output."""
    paths = (ROOT / folder).rglob("*") if folder else [*ROOT.glob("*.*"), ROOT / "Makefile"]
    parts = ("backends", "__pycache__")
    return [p for p in paths if p.is_file() and p.suffix != ".md" and not p.is_relative_to(REPORT) and not set(parts) & {*p.relative_to(ROOT).parts[:-1]}]


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

    def test_only_listed_files_name_backends(self) -> None:
        known = {path.name for path in (ROOT / "backends").iterdir() if path.is_dir()} | {"hip"}
        known -= {"openmp", "reference", "program", "skeleton"}  # the first two are always built and are defaults
        self.assertGreater(len(known), 6)
        word = re.compile(rf"\b({'|'.join(sorted(known))})\b")
        found = set()
        for path in (path for folder in (*FOLDERS, "cli", "cmake", "packaging", "tools", "") for path in files_below(folder)):
            if word.search(re.sub(r"//.*", "", path.read_text(encoding="utf-8", errors="replace"))):
                found.add(path.relative_to(ROOT).as_posix())
        allowed = tuple(NAME_BACKENDS)
        self.assertEqual([file for file in sorted(found) if not file.startswith(allowed)], [])
        self.assertEqual([entry for entry in allowed if not any(file.startswith(entry) for file in found)], [], "no longer needed")


if __name__ == "__main__":
    unittest.main()
