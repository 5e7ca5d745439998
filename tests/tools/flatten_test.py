#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cmake/FlattenKernel.cmake gives the literals of the kernel source their GLSL suffixes. If it cannot read a literal,
the build stops."""

from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def flattened(literal: str) -> tuple[int, str]:
    """Flattens the viewer's shader with a kernel that contains the literal. Returns exit code, and shader or message."""
    with tempfile.TemporaryDirectory() as folder:
        kernel, shader = Path(folder, "made.h"), Path(folder, "made.frag")
        kernel.write_text(f"FN real made_constant() {{ return {literal}; }}\n", encoding="utf-8")
        done = subprocess.run(
            ["cmake", "-DFRACTAL=made", f"-DTEXT={kernel}", f"-DFILE={shader}", "-P", ROOT / "report/viewer/flatten.cmake"],
            capture_output=True,
            text=True,
            check=False,
        )
        return done.returncode, shader.read_text(encoding="utf-8") if done.returncode == 0 else done.stderr


class Flatten(unittest.TestCase):
    def test_literals_get_suffixes(self) -> None:
        for literal, expected in (
            ("R(0.5)", "BY_PRECISION(0.5lf, 0.5f)"),
            ("R(-1.25e-3)", "BY_PRECISION(-1.25e-3lf, -1.25e-3f)"),
            ("BY_PRECISION(1.0e-290, 1.0e-30)", "BY_PRECISION(1.0e-290lf, 1.0e-30f)"),
        ):
            code, shader = flattened(literal)
            self.assertEqual(code, 0, shader)
            self.assertIn(f"return {expected};", shader)

    def test_other_literals_stop_the_build(self) -> None:
        for literal in ("R(1.5E3)", "R(1.5e+3)", "R(0x1p3)", "R(0.5f)", "R(PI)"):
            code, message = flattened(literal)
            self.assertNotEqual(code, 0, literal)
            self.assertIn(literal, " ".join(message.split()))


if __name__ == "__main__":
    unittest.main()
