# SPDX-License-Identifier: Apache-2.0
"""What the live viewer needs in a page: shaders, the table of fractals and scripts, for templates/viewer.html.j2."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from markupsafe import Markup

from . import fractal_table
from .shaders import TEXTS, shader

FOLDER = Path(__file__).parents[1]


def raw(name: str) -> Markup:
    """A style sheet or script of the report, as it is."""
    return Markup((FOLDER / name).read_text(encoding="utf-8"))


def scripts() -> Markup:
    """The viewer's scripts, in their order."""
    return Markup("\n").join(raw(f"viewer/{name}.js") for name in ("camera", "painter", "viewer"))


def _embedded(data: Any) -> Markup:
    """JSON that can stand in a script element."""
    return Markup(json.dumps(data, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c"))


def material(table: dict[str, Any], work: Path) -> dict[str, Any]:
    """The template's values. `table`: what bin/render --list-fractals --json prints; `work`: a folder for files in between."""
    names = [row["name"] for row in table["fractals"] if row["name"] in TEXTS]
    texts = {fractal: shader(fractal, work) for fractal in names}
    return {
        "data": _embedded({"shaders": texts}),
        "table": Markup(fractal_table.script(table, names)),
        "fractals": names,
    }
