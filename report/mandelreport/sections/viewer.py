# SPDX-License-Identifier: Apache-2.0
"""The live viewer."""

from typing import Any

from .. import viewer
from . import Material


def section(material: Material) -> dict[str, Any]:
    return viewer.material(material.studio.render, material.work / "shaders", "tools/setup report")
