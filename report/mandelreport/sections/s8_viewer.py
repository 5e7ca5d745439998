# SPDX-License-Identifier: Apache-2.0
"""Section 8: the live viewer."""

from __future__ import annotations

import json
from typing import Any

from markupsafe import Markup

from .. import fractal_table
from ..blocks import Missing
from ..shaders import TEXTS, missing_tools, shader
from . import Material


def _embedded(data: Any) -> Markup:
    """JSON that can stand in a script element."""
    return Markup(json.dumps(data, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c"))


def section(material: Material) -> dict[str, Any]:
    absent = missing_tools()
    if absent:
        return {"missing": Missing(f"The viewer's shaders, as {', '.join(absent)} is not there", "report/setup")}
    table = material.studio.fractals
    if table is None:
        return {"missing": Missing("The viewer's table of fractals, which bin/render prints", "make build")}
    names = [row["name"] for row in table["fractals"] if row["name"] in TEXTS]
    texts = {fractal: shader(fractal, material.work / "shaders") for fractal in names}
    return {
        "data": _embedded({"shaders": texts}),
        "table": Markup(fractal_table.script(table, names)),
        "fractals": names,
    }
