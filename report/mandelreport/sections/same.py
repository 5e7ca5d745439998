# SPDX-License-Identifier: Apache-2.0
"""Agreement of all pictures: both scenes, and the results of verification."""

from typing import Any

from PIL import Image

from ..blocks import Block, Figure, Missing, Table
from ..pictures import SCENES, Key, encoded
from . import Material

SHOWN = 400  # pixels


def _picture(material: Material, fractal: str) -> Figure | None:
    studio = material.studio
    picture = studio.picture(Key(fractal, "double", "exact", material.backends.host)) if studio.there else None
    if picture is None:
        return None
    small = picture.image.resize((SHOWN, SHOWN), Image.Resampling.LANCZOS)
    alt = f"The {fractal}'s official scene in double and exact mode."
    return Figure(encoded(small, "webp", quality=90), alt, f"The {fractal.capitalize()}, official scene.", False)


def _verification(material: Material) -> Block:
    """Returns a table of the verification results of the primary study, with backends as columns."""
    bench = material.answers.primary
    if bench is None:
        return Missing("The verification", "make bench")
    names = material.backends.order(row.backend for row in bench.rows if row.timed)
    kinds = list(dict.fromkeys(row.kind for row in bench.rows if row.timed))
    said = {(*row.kind, row.backend): row.verification["text"] for row in bench.rows if row.timed}
    return Table(
        ["fractal", "precision", "mode", *names],
        [[*kind, *(said.get((*kind, name), "–") for name in names)] for kind in kinds],
        f"Results of verification ({bench.name}). Same bits: all bits of colour and depth equal those of the scalar kernel. Off: "
        "pixels with a byte that differs by more than 2 of 255.",
    )


def section(material: Material) -> dict[str, Any]:
    return {
        "pictures": [figure for fractal in SCENES if (figure := _picture(material, fractal))],
        "verification": _verification(material),
        "reference": material.backends.reference,
    }
