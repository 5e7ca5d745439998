# SPDX-License-Identifier: Apache-2.0
"""Values of the live viewer for templates/viewer.html.j2: shaders, the table of fractals, and scripts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from markupsafe import Markup

from . import fractal_table
from .shaders import TEXTS, shader

FOLDER = Path(__file__).parents[1]


def raw(name: str) -> Markup:
    """Returns a style sheet or script of the report, unescaped."""
    return Markup((FOLDER / name).read_text(encoding="utf-8"))


def scripts() -> Markup:
    """Returns the viewer's scripts, in their order."""
    return Markup("\n").join(raw(f"viewer/{name}.js") for name in ("camera", "painter", "viewer"))


def _embedded(data: Any) -> Markup:
    """Returns JSON for use inside a script element."""
    return Markup(json.dumps(data, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c"))


def material(table: dict[str, Any], work: Path) -> dict[str, Any]:
    """Returns the template's values. `table`: output of bin/render --list-fractals --json; `work`: folder for
    intermediate files."""
    names = [row["name"] for row in table["fractals"] if row["name"] in TEXTS]
    texts = {fractal: shader(fractal, work) for fractal in names}
    return {
        "data": _embedded({"shaders": texts}),
        "table": Markup(fractal_table.script(table, names)),
        "fractals": names,
    }
