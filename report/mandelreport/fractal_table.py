# SPDX-License-Identifier: Apache-2.0
"""Converts the table of fractals (bin/render --list-fractals --json) to JavaScript for the viewer."""

from __future__ import annotations

import json
from typing import Any

INPUTS = "(shape, escape, iterations, largest, conservative)"  # inputs of every formula (core/scene/formula.h)


def _row(row: dict[str, Any]) -> str:
    functions = {
        "constants": f"[{', '.join(row['constants'])}]",
        "whole": row["whole"],
        "step_factor": row["step_factor"],
    }
    data = {name: value for name, value in row.items() if name not in functions}
    texts = [f"{name}: {INPUTS} => {text}" for name, text in functions.items()]
    return f"{{ ...{json.dumps(data, sort_keys=True)}, {', '.join(texts)} }}"


def script(table: dict[str, Any], names: list[str] | None = None) -> str:
    """Returns an expression: `rules`, for all scenes, and `rows` by name, with formulas as functions."""
    rows = {row["name"]: _row(row) for row in table["fractals"] if names is None or row["name"] in names}
    body = ",\n".join(f"{json.dumps(name)}: {row}" for name, row in rows.items())
    return (
        "(() => {\nconst { min, max, pow, sqrt, abs, floor, sign } = Math, pick = (on, a, b) => (on ? a : b);\n"
        f"return {{ rules: {json.dumps(table['scene'], sort_keys=True)}, rows: {{\n{body} }} }};\n}})()"
    )
