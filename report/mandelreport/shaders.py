# SPDX-License-Identifier: Apache-2.0
"""The viewer's shaders: the kernel source as GLSL ES 3.00, through glslang and spirv-cross."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

from .errors import InputError

TOOLS = ("cmake", "glslangValidator", "spirv-cross")
ROOT = Path(__file__).parents[2]
FLATTEN = ROOT / "report" / "viewer" / "flatten.cmake"
KERNEL = ROOT / "core" / "kernel"
# Folders of kernel sources. The environment adds folders, like the build option of the same name.
FOLDERS = [KERNEL / "fractals", *(Path(f) for f in os.environ.get("MANDELMARCH_MORE_FRACTALS", "").split(";") if f)]
TEXTS = {path.stem: path.resolve() for folder in FOLDERS for path in sorted(folder.glob("*.h"))}


def missing_tools() -> list[str]:
    return [tool for tool in TOOLS if shutil.which(tool) is None]


def _run(*command: object) -> None:
    run = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        lines = (run.stdout + run.stderr).strip().splitlines() or ["failed without a message"]
        raise InputError(f"{command[0]}: {lines[-1]}")


def shader(fractal: str, work: Path) -> str:
    """Returns the fragment shader of one fractal; `work`: a folder for intermediate files."""
    work.mkdir(parents=True, exist_ok=True)
    text, module, result = (work / f"{fractal}.{ending}" for ending in ("frag", "spv", "es"))
    _run("cmake", "-D", f"FRACTAL={fractal}", "-D", f"TEXT={TEXTS[fractal]}", "-D", f"FILE={text}", "-P", FLATTEN)
    _run("glslangValidator", "--quiet", "-V", "--target-env", "vulkan1.1", "-S", "frag", "-o", module, text)
    _run("spirv-cross", "--es", "--version", "300", "--output", result, module)
    # Without indentation, which is a fifth of the text.
    return "\n".join(line.strip() for line in result.read_text(encoding="utf-8").splitlines() if line.strip()) + "\n"
