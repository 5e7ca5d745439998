# SPDX-License-Identifier: Apache-2.0
"""Section 8: the live viewer."""

from __future__ import annotations

import json
from typing import Any

from markupsafe import Markup

from ..blocks import Missing
from ..parameters import read_parameters
from ..pictures import ROOT
from ..shaders import FRACTALS, constants, missing_tools, shaders
from . import Material

SCENES = {"mandelbulb": "paramsBulb.dat", "mandelbox": "paramsBox.dat", "julia": "paramsJulia.dat"}


def _embedded(data: Any) -> Markup:
    """JSON that can stand in a script element."""
    return Markup(json.dumps(data, separators=(",", ":"), sort_keys=True).replace("<", "\\u003c"))


def section(material: Material) -> dict[str, Any]:
    absent = missing_tools()
    if absent:
        return {"missing": Missing(f"The viewer's shaders, as {', '.join(absent)} is not there", "report/setup")}
    known = [fractal for fractal in FRACTALS if fractal in SCENES]
    texts = shaders(material.work / "shaders")
    return {
        "data": _embedded(
            {
                "shaders": {fractal: texts[fractal] for fractal in known},
                "constants": {fractal: constants(fractal) for fractal in known},
                "scenes": {fractal: read_parameters(ROOT / SCENES[fractal]) for fractal in known},
            }
        ),
        "fractals": sorted(known, key=list(SCENES).index),
    }
