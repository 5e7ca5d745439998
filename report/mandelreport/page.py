# SPDX-License-Identifier: Apache-2.0
"""Combines sections and templates into one HTML page."""

import collections

from . import viewer
from .sections import (
    Material,
    environments,
    flight,
    front,
    pictures,
    speed,
    sweeps,
    tables,
    why,
)

# Sections of the main part: a name, which is that of its macro in sections.html.j2 and its anchor; a title; a function
# that returns the values for the macro. The front page comes before the sections.
MAIN = [
    ("method", "Subject and method of measurement", environments.method),
    ("same", "The same picture on every backend", pictures.same),
    ("speed", "Speed of the backends", speed.speed),
    ("why", "Mandelbox or Mandelbulb, float or double", why.why),
    ("parallel", "Parallelisation", sweeps.parallel),
    ("film", "The film and the choice of its frames", flight.film),
    ("discussion", "Discussion", environments.discussion),
    ("artifact", "Reproduction", lambda material: {}),
]
APPENDIX = [
    ("pictures", "Pictures and their differences", pictures.pictures),
    ("tables", "All timings", tables.tables),
    ("sweeps", "Sweeps", sweeps.sweeps),
    ("flight", "Flights", flight.flights),
    ("environments", "Machines and settings", environments.environments),
    ("viewer", "Live viewer", lambda material: viewer.material(material.studio.render, material.work / "shaders", "tools/setup report")),
]


def render(material: Material) -> str:
    """Returns the whole page. The same results and programs give the same page."""
    last: collections.Counter[str] = collections.Counter()

    def number(kind: str) -> int:
        """Returns the number of the next figure or table."""
        last[kind] += 1
        return last[kind]

    environment = viewer.environment()
    environment.globals.update(number=number)
    return environment.get_template("page.html.j2").render(
        macros="macros.html.j2",
        front=front.section(material),
        main=[(name, title, values(material)) for name, title, values in MAIN],
        appendix=[(name, title, values(material)) for name, title, values in APPENDIX],
        machines=list(dict.fromkeys(bench.machine for bench in material.results.benches)),
        **viewer.assets(),
    )
