# SPDX-License-Identifier: Apache-2.0
"""Combines sections and templates into one HTML page."""

import importlib
from typing import Any

from . import sections, viewer
from .blocks import Numbers, ref
from .sections import Material, front

# Sections of the main part. A section has a name, which is that of its module, template and anchor, and a title. The
# front page comes before the sections.
MAIN = [
    ("method", "Subject and method of measurement"),
    ("same", "The same picture on every backend"),
    ("speed", "Speed of the backends"),
    ("why", "Mandelbox or Mandelbulb, float or double"),
    ("parallel", "Parallelisation"),
    ("film", "The film and the choice of its frames"),
    ("discussion", "Discussion"),
    ("artifact", "Reproduction"),
]
APPENDIX = [
    ("pictures", "Pictures and their differences"),
    ("tables", "All timings"),
    ("sweeps", "Sweeps"),
    ("flight", "Flights"),
    ("environments", "Machines and settings"),
    ("viewer", "Live viewer"),
]
TEXT_ONLY = ("discussion", "artifact")


def _contents(material: Material, names: list[tuple[str, str]]) -> list[tuple[str, str, dict[str, Any]]]:
    contents = []
    for name, title in names:
        module = None if name in TEXT_ONLY else importlib.import_module(f".{name}", sections.__name__)
        contents.append((name, title, module.section(material) if module else {}))
    return contents


def _filled(template: str, numbers: Numbers, **values: Any) -> str:
    environment = viewer.environment()
    environment.globals.update(macros="macros.html.j2", number=numbers.next, ref=ref)
    return environment.get_template(template).render(**values)


def render(material: Material) -> str:
    """Returns the whole page. The same results and programs give the same page."""
    numbers = Numbers()
    page = _filled(
        "page.html.j2",
        numbers,
        front=front.section(material),
        main=_contents(material, MAIN),
        appendix=_contents(material, APPENDIX),
        compilers=material.results.host_compilers(),
        gpu_measured=material.results.gpu_measured(),
        machines=list(dict.fromkeys(bench.machine for bench in material.results.benches)),
        style=viewer.raw("templates/style.css"),
        slider=viewer.raw("templates/slider.js"),
        viewer=viewer.scripts(),
    )
    return numbers.resolved(page)
