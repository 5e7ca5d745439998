# SPDX-License-Identifier: Apache-2.0
"""The live viewer of templates/viewer.html.j2: its shaders (the kernel source as GLSL ES 3.00, through glslang and
spirv-cross), the table of fractals as JavaScript, and its scripts."""

import json
import os
import shutil
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from .blocks import Missing
from .errors import output_of

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "report"
TOOLS = ("cmake", "glslangValidator", "spirv-cross")
INPUTS = "(shape, escape, iterations, largest, conservative)"  # inputs of every formula (core/scene/formula.h)
FLATTEN = FOLDER / "viewer" / "flatten.cmake"
KERNEL = ROOT / "core" / "kernel"
VIEWS = ROOT / "scenes"  # contains the files NAME.FRACTAL.dat
FIRST = "reef"  # the view with which the viewer begins
# Folders of the fractals' kernel sources. The environment variable adds folders, like the build option of the same
# name.
FOLDERS = [KERNEL / "fractals", *(Path(f) for f in os.environ.get("MANDELMARCH_MORE_FRACTALS", "").split(";") if f)]
TEXTS = {path.stem: path.resolve() for folder in FOLDERS for path in sorted(folder.glob("*.h"))}


def missing_tools() -> list[str]:
    return [tool for tool in TOOLS if shutil.which(tool) is None]


def shader(fractal: str, work: Path) -> str:
    """Returns the fragment shader of one fractal; `work`: a folder for intermediate files."""
    work.mkdir(parents=True, exist_ok=True)
    text, module, result = (work / f"{fractal}.{ending}" for ending in ("frag", "spv", "es"))
    output_of("cmake", "-D", f"FRACTAL={fractal}", "-D", f"TEXT={TEXTS[fractal]}", "-D", f"FILE={text}", "-P", FLATTEN)
    output_of("glslangValidator", "--quiet", "-V", "--target-env", "vulkan1.1", "-S", "frag", "-o", module, text)
    output_of("spirv-cross", "--es", "--version", "300", "--output", result, module)
    # Removes the indentation, a fifth of the text.
    return "\n".join(line.strip() for line in result.read_text(encoding="utf-8").splitlines() if line.strip()) + "\n"


def _row(row: dict[str, Any]) -> str:
    functions = {
        "constants": f"[{', '.join(row['constants'])}]",
        "whole": row["whole"],
        "step_factor": row["step_factor"],
    }
    data = {name: value for name, value in row.items() if name not in functions}
    texts = [f"{name}: {INPUTS} => {text}" for name, text in functions.items()]
    return f"{{ ...{json.dumps(data, sort_keys=True)}, {', '.join(texts)} }}"


def table_script(table: dict[str, Any], names: list[str] | None = None) -> str:
    """Returns a JavaScript expression, an object with `rules`, which apply to all scenes, and `rows`, the fractals by
    name, whose formulas are functions. `names`: the fractals to include; None: all."""
    rows = {row["name"]: _row(row) for row in table["fractals"] if names is None or row["name"] in names}
    body = ",\n".join(f"{json.dumps(name)}: {row}" for name, row in rows.items())
    return (
        "(() => {\nconst { min, max, pow, sqrt, abs, floor, sign } = Math, pick = (on, a, b) => (on ? a : b);\n"
        f"return {{ rules: {json.dumps(table['scene'], sort_keys=True)}, rows: {{\n{body} }} }};\n}})()"
    )


def environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(FOLDER / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _raw(name: str) -> Markup:
    """Returns a style sheet or script of the report, unescaped."""
    return Markup((FOLDER / name).read_text(encoding="utf-8"))


def assets() -> dict[str, Markup]:
    """Returns the style sheet and the scripts of a page, by their names in templates."""
    scripts = Markup("\n").join(_raw(f"viewer/{name}.js") for name in ("camera", "painter", "viewer"))
    return {"style": _raw("templates/style.css"), "slider": _raw("templates/slider.js"), "viewer": scripts}


def views(fractals: list[str]) -> list[dict[str, str]]:
    """Returns the views of these fractals, FIRST before the others."""
    found = []
    for file in VIEWS.glob("*.*.dat"):
        name, fractal, _ = file.name.split(".")
        if fractal in fractals:
            found.append({"name": name, "fractal": fractal, "dat": file.read_text(encoding="utf-8")})
    return sorted(found, key=lambda view: (view["name"] != FIRST, view["name"]))


def _embedded(data: Any) -> Markup:
    """Returns data as JSON that can stand inside a script element of HTML."""
    return Markup(json.dumps(data, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c"))


def material(render: Path, work: Path, set_up: str) -> dict[str, Any]:
    """Returns the values for the viewer's template, or the reason why the page has no viewer. `render`: bin/render;
    `work`: a folder for intermediate files; `set_up`: the command that installs missing tools."""
    if absent := missing_tools():
        return {"missing": Missing(f"The viewer's shaders, as {', '.join(absent)} is missing", set_up)}
    if not render.exists():
        return {"missing": Missing("The viewer's table of fractals, from bin/render", "make build")}
    table = json.loads(output_of(render, "--list-fractals", "--json"))
    names = [row["name"] for row in table["fractals"] if row["name"] in TEXTS]
    texts = {fractal: shader(fractal, work) for fractal in names}
    shown = views(names)
    return {
        "data": _embedded({"shaders": texts, "views": shown}),
        "table": Markup(table_script(table, names)),
        "fractals": names,
        "views": [view["name"] for view in shown],
    }
