# SPDX-License-Identifier: Apache-2.0
"""The page: sections and templates into one HTML text."""

from __future__ import annotations

from pathlib import Path

import jinja2

from . import viewer
from .sections import Material, s1_pictures, s2_timings, s3_parallel, s4_flight, s5_why, s6_summary, s7_reproduce, s8_viewer

FOLDER = Path(__file__).parents[1]
# Name in the page, title, module.
SECTIONS = [
    ("pictures", "The pictures", s1_pictures),
    ("timings", "The timings", s2_timings),
    ("parallel", "How it was parallelised", s3_parallel),
    ("flight", "How the frames are chosen", s4_flight),
    ("why", "Mandelbox and Mandelbulb: which is slower, and why", s5_why),
    ("summary", "Summary of the film", s6_summary),
    ("reproduce", "How to reproduce everything", s7_reproduce),
    ("viewer", "Live viewer", s8_viewer),
]


def render(material: Material) -> str:
    """The whole page. The same results and programs give the same text."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(FOLDER / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    contents = [(name, title, module.section(material)) for name, title, module in SECTIONS]
    machines = list(dict.fromkeys(bench.machine for bench in material.results.benches))
    return environment.get_template("page.html.j2").render(
        contents=contents,
        machines=machines,
        style=viewer.raw("templates/style.css"),
        slider=viewer.raw("templates/slider.js"),
        viewer=viewer.scripts(),
    )
