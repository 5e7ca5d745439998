# SPDX-License-Identifier: Apache-2.0
"""Agreement of all pictures: both scenes, the results of verification, all pictures and their differences."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PIL import Image, ImageFilter

from ..blocks import Block, Figure, Missing, Table
from ..pictures import SCENES, SIDE, Key, Picture, Studio, encoded
from ..text import join
from . import Material

SHOWN = 400  # pixels


@dataclass(frozen=True)
class Shown:
    """A picture, stored once for all keys whose pictures have the same bytes."""

    name: str  # in the page
    figure: Figure
    keys: list[Key]
    map: Figure | None


def _names(keys: list[Key]) -> str:
    """Returns the names of pictures, such as "one, other (double, exact); one (float, exact)"."""
    kinds: dict[str, list[str]] = {}
    for key in keys:
        kinds.setdefault(f"{key.precision}, {key.mode}", []).append(key.backend)
    return "; ".join(f"{join(backends)} ({kind})" for kind, backends in kinds.items())


def _compared(studio: Studio, a: Picture, b: Picture) -> str:
    """Returns a description of the difference of two pictures. Pictures with the same bytes are also compared in all
    bits of colour and depth, if both are exact and of one precision."""
    found = studio.compare(a.drawn, b.drawn)
    if not found["same"]:
        counts = (found[f"{kind}_pixels"] for kind in ("differing", "visibly_differing"))
        return "{:,} px, {:,} visibly, max {}".format(*counts, found["largest_difference"])
    if a.values and b.values and a.key.precision == b.key.precision and studio.compare(a.values, b.values)["same"]:
        return "same bits"
    return "same bytes"


def _visible(found: dict[str, Any]) -> str:
    """Formats the fraction of pixels that differ visibly according to imgdiff."""
    return f"{100 * found['visibly_differing_pixels'] / (found['width'] * found['height']):.3f} %"


def _psnr(found: dict[str, Any]) -> str:
    return "∞" if found["psnr_db"] is None else f"{found['psnr_db']:.1f}"


def _map(path: Path) -> str:
    """Returns a map of differences. Each differing pixel is enlarged by a pixel on all sides, so that it is visible."""
    with Image.open(path) as drawn:
        # 16 greys compress well.
        return encoded(drawn.convert("L").filter(ImageFilter.MinFilter(3)).quantize(16), "png", optimize=True)


def _show(material: Material, pictures: dict[Key, Picture], fractal: str) -> list[Shown]:
    groups: dict[str, list[Picture]] = {}
    for picture in pictures.values():
        if picture.key.fractal == fractal:
            groups.setdefault(picture.digest, []).append(picture)
    shown = []
    for number, same in enumerate(groups.values()):
        first = same[0]
        keys = [picture.key for picture in same]
        names = _names(keys)
        source = encoded(first.image, "webp", lossless=True, quality=80, method=4)
        figure = Figure(source, f"The {fractal}'s official scene, rendered by {names}.", names)
        # Compares with the reference's picture in the same mode, in double.
        canonical = pictures.get(Key(fractal, "double", first.key.mode, material.backends.reference))
        drawn = None
        if canonical is not None and first.key.backend != canonical.key.backend:
            difference = material.studio.compare(canonical.drawn, first.drawn)
            if not difference["same"]:
                drawn = Figure(
                    _map(difference["map"]),
                    f"Map of the {fractal}'s {difference['differing_pixels']} pixels that differ between {names} and {canonical.key}.",
                    f"{names}, compared with {canonical.key}: {_compared(material.studio, canonical, first)}",
                )
        shown.append(Shown(f"{fractal}-{number}", figure, keys, drawn))
    return shown


def _agreement(material: Material, pictures: dict[Key, Picture], fractal: str, precision: str, mode: str) -> Table | None:
    here = [p for p in pictures.values() if (p.key.fractal, p.key.precision, p.key.mode) == (fractal, precision, mode)]
    names = material.backends.order([picture.key.backend for picture in here])
    if len(here) < 2:
        return None
    by_name = {picture.key.backend: picture for picture in here}
    rows = []
    for a in names[:-1]:
        cells = [
            _compared(material.studio, by_name[a], by_name[b]) if names.index(b) > names.index(a) else ""
            for b in names[1:]
        ]
        rows.append([a, *cells])
    return Table(["", *names[1:]], rows, f"{fractal}, {precision}, {mode}")


def _float_against_double(material: Material, pictures: dict[Key, Picture]) -> Table:
    rows = []
    for key, picture in pictures.items():
        if key.precision == "float":
            double = pictures.get(Key(key.fractal, "double", key.mode, key.backend))
            if double:
                found = material.studio.compare(double.drawn, picture.drawn)
                rows.append(
                    [
                        key.fractal,
                        key.mode,
                        key.backend,
                        f"{found['differing_pixels']:,}",
                        f"{found['visibly_differing_pixels']:,}",
                        _visible(found),
                        str(found["largest_difference"]),
                        _psnr(found),
                    ]
                )
    return Table(
        ["fractal", "mode", "backend", "pixels that differ", "visibly", "fraction", "largest / 255", "PSNR [dB]"],
        rows,
        "Float compared with double on the same backend. Visibly: a byte differs by more than 2 of 255.",
        [3, 4, 5, 6, 7],
    )


def _range(values: list[float], places: int) -> str:
    return f"{min(values):.{places}f} – {max(values):.{places}f}"


def random_errors(results: list[dict[str, Any]]) -> Table:
    """Returns a table of the results of `bench random`: the errors of fast pictures of random scenes."""
    rows = []
    for data in results:
        for entry in data["sums"]:
            sets, seeds, every = list(entry["sets"].values()), list(entry["sets"]), entry["all"]
            rows.append(
                [
                    entry["fractal"],
                    entry["precision"],
                    data["backend"] + (f" without {data['without']}" if data["without"] else ""),
                    f"{len(sets)} of {sets[0]['scenes']}: {seeds[0]} … {seeds[-1]}",
                    _range([one["off_percent"] for one in sets], 2),
                    _range([one["hit_or_miss_percent"] for one in sets], 3),
                    f"{every['scenes_far_off']} of {every['scenes']}",
                    str(every["of_these_short_of_digits"]),
                    f"{every['worst_off_percent']:.1f}",
                ]
            )
    headers = [
        "fractal",
        "precision",
        "backend",
        "sets and their seeds",
        "visible differences by set [%]",
        "hit or miss differs by set [%]",
        "scenes over 2 %",
        "of these limited by float",
        "worst [%]",
    ]
    return Table(
        headers,
        rows,
        "Fast pictures of random scenes compared with the reference's canonical ones (bench random): pixels that "
        "differ visibly, and pixels that hit the surface in one picture only. Limited by float: in exact mode, too, "
        "more than 2 % of the pixels differ between float and double.",
        [3, 4, 5, 6, 7, 8],
    )


def pictures(material: Material) -> dict[str, Any]:
    pictures = {picture.key: picture for picture in material.studio.all(material.backends.names)}
    if not pictures:
        return {"missing": Missing("The pictures, as bin/render is missing", "make build report")}
    tables = [
        table
        for fractal in SCENES
        for mode in ("exact", "fast")
        for precision in ("double", "float")
        if (table := _agreement(material, pictures, fractal, precision, mode))
    ]
    stored = {fractal: _show(material, pictures, fractal) for fractal in SCENES}
    devices = dict.fromkeys((p.key.backend, p.device) for p in pictures.values())
    reasons = dict.fromkeys(
        (key.backend, reason.removeprefix("render: ")) for key, reason in material.studio.reasons.items()
    )
    return {
        "side": SIDE,
        "drawn": len(pictures),
        "stored": stored,
        "choices": {
            fractal: [(picture.name, str(key)) for picture in shown for key in picture.keys]
            for fractal, shown in stored.items()
        },
        "count": sum(len(shown) for shown in stored.values()),
        "tables": tables,
        "float": _float_against_double(material, pictures),
        "random": random_errors(material.results.random)
        if material.results.random
        else Missing("Fast pictures of random scenes", "bin/bench random --json results/random.json"),
        "devices": Table(
            ["backend", "device"], [list(entry) for entry in devices], "Devices that rendered the pictures of this section."
        ),
        "reasons": list(reasons),
    }


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


def same(material: Material) -> dict[str, Any]:
    return {
        "pictures": [figure for fractal in SCENES if (figure := _picture(material, fractal))],
        "verification": _verification(material),
        "reference": material.backends.reference,
    }
