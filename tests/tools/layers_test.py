#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sources include only files of their own folder and of lower layers, in the order of LAYERS. A folder of LAYERS
contains its subfolders, except those that LAYERS lists themselves."""

from __future__ import annotations

import re
import unittest
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# The layers, from the lowest to the highest. Folders of one layer must not include files of each other.
LAYERS = [
    ["core/kernel"],
    ["core/text"],
    ["core/os"],
    ["core/image"],
    ["core/image/formats"],
    ["core/scene"],
    ["core/scene/fractals"],
    ["core/render"],
    ["core/gpu", "core/instruments", "core/isolation"],
    ["core/models"],
    sorted(f"backends/{path.name}" for path in (ROOT / "backends").iterdir() if path.is_dir()),
    ["backends"],
    ["apps/cli", "flight/field"],
    ["flight/path"],
    ["flight/audit"],
    ["flight/route"],
    ["flight/ride"],
    ["flight/film"],
    ["apps"],
    ["apps/explore/model", "bench/statistics"],
    ["apps/explore/actions", "bench/counting"],
    ["apps/explore/view", "bench/result"],
    ["apps/explore", "bench/measure", "bench/print"],
    ["bench/fidelity"],
    ["bench/command"],
    ["bench"],
]
LEVELS = {folder: level for level, folders in enumerate(LAYERS) for folder in folders}


def layer(path: str) -> str:
    """Returns the innermost folder of LAYERS that contains the file."""
    folder = Path(path).parent
    while str(folder) not in LEVELS:
        if folder == folder.parent:
            raise ValueError(f"{path}: in no layer")
        folder = folder.parent
    return str(folder)


def includes() -> Iterator[tuple[str, str]]:
    """Yields (file, included file) for each include of a project's file in the project's sources."""
    for top in sorted({folder.split("/")[0] for folder in LEVELS}):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in {".h", ".cpp", ".in", ".cl", ".comp", ".cu"}:
                for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', path.read_text(encoding="utf-8"), re.M):
                    if (ROOT / name).is_file():
                        yield path.relative_to(ROOT).as_posix(), name


def goes_down(source: str, target: str) -> bool:
    upper, lower = layer(source), layer(target)
    return upper == lower or LEVELS[lower] < LEVELS[upper]


class Layers(unittest.TestCase):
    def test_includes_go_down(self) -> None:
        found = list(includes())
        self.assertGreater(len(found), 1000)
        self.assertEqual([pair for pair in found if not goes_down(*pair)], [])

    def test_the_harness_names_no_backend(self) -> None:
        self.assertEqual([pair for pair in includes() if re.match("bench/.*/", pair[0]) and pair[1].startswith("backends/")], [])

    def test_an_include_that_goes_up_or_across_is_found(self) -> None:
        self.assertFalse(goes_down("core/os/program.cpp", "core/scene/scene.h"))
        self.assertFalse(goes_down("backends/cuda/cuda.cpp", "backends/openacc/openacc.h"))
        self.assertFalse(goes_down("flight/audit/audit.cpp", "flight/route/roadmap.h"))


if __name__ == "__main__":
    unittest.main()
