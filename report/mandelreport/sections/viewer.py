# SPDX-License-Identifier: Apache-2.0
"""The live viewer."""

from __future__ import annotations

from typing import Any

from .. import viewer
from ..blocks import Missing
from . import Material


def section(material: Material) -> dict[str, Any]:
    absent = viewer.missing_tools()
    if absent:
        return {"missing": Missing(f"The viewer's shaders, as {', '.join(absent)} is missing", "report/setup")}
    table = material.studio.fractals
    if table is None:
        return {"missing": Missing("The viewer's table of fractals, from bin/render", "make build")}
    return viewer.material(table, material.work / "shaders")
