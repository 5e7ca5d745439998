# SPDX-License-Identifier: Apache-2.0
"""Pictures of all backends and their differences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..agreement import compare, difference_map, encode, expected_picture, flip_mean
from ..blocks import Block, Figure, Missing, Table, data_uri
from ..pictures import SCENES, SIDE, Key, Picture
from ..random_scenes import random_table
from ..text import digits, join
from . import Material


@dataclass(frozen=True)
class Shown:
    """A picture, stored once for all keys with the same bytes."""

    name: str  # in the page
    figure: Figure
    keys: list[Key]
    map: Figure | None


def _names(keys: list[Key]) -> str:
    """Returns "openmp, opencl (double, exact); openmp (float, exact)"."""
    kinds: dict[str, list[str]] = {}
    for key in keys:
        kinds.setdefault(f"{key.precision}, {key.mode}", []).append(key.backend)
    return "; ".join(f"{join(backends)} ({kind})" for kind, backends in kinds.items())


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
        figure = Figure(data_uri("image/webp", encode(first)), f"The {fractal}'s official scene, rendered by {names}.", names)
        canonical = expected_picture(pictures, first, material.backends.reference)
        drawn = None
        if canonical is not None:
            difference = compare(material.studio, canonical, first)
            if difference.differing:
                drawn = Figure(
                    data_uri("image/png", difference_map(canonical, first)),
                    f"Map of the {fractal}'s {difference.differing} pixels that differ between {names} and {canonical.key}.",
                    f"{names}, compared with {canonical.key}: {difference.words}",
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
            compare(material.studio, by_name[a], by_name[b]).words if names.index(b) > names.index(a) else ""
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
                found = compare(material.studio, double, picture)
                rows.append(
                    [
                        key.fractal,
                        key.mode,
                        key.backend,
                        f"{found.differing:,}",
                        f"{found.visible:,}",
                        f"{100 * found.visible / found.pixels:.3f} %",
                        str(found.largest),
                        "∞" if found.psnr is None else f"{found.psnr:.1f}",
                    ]
                )
    return Table(
        ["fractal", "mode", "backend", "pixels that differ", "visibly", "fraction", "largest / 255", "PSNR [dB]"],
        rows,
        "Float compared with double on the same backend. Visibly: a byte differs by more than 2 of 255.",
        [3, 4, 5, 6, 7],
    )


def _flip(material: Material, pictures: dict[Key, Picture]) -> Block:
    rows = []
    for picture in pictures.values():
        key = picture.key
        canonical = pictures.get(Key(key.fractal, "double", "fast", material.backends.reference))
        if key.mode != "fast" or key.backend == material.backends.reference or canonical is None:
            continue
        mean = flip_mean(material.studio, canonical, picture)
        if mean is None:
            return Missing("FLIP, as the package flip-evaluator is not installed", "make python")
        found = compare(material.studio, canonical, picture)
        rows.append(
            [
                key.fractal,
                key.precision,
                key.backend,
                digits(mean),
                f"{100 * found.visible / found.pixels:.3f} %",
                "∞" if found.psnr is None else f"{found.psnr:.1f}",
            ]
        )
    if not rows:
        return Missing("FLIP of the fast pictures", "make build report")
    return Table(
        ["fractal", "precision", "backend", "mean FLIP", "differ visibly", "PSNR [dB]"],
        rows,
        "Fast pictures compared with the canonical one (reference, double, fast): FLIP (flip-evaluator 1.7, LDR; 0: the same "
        "to the eye, 1: the largest difference), the fraction of pixels with a byte that differs by more than 2, and PSNR.",
        [3, 4, 5],
    )


def section(material: Material) -> dict[str, Any]:
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
        "flip": _flip(material, pictures),
        "random": random_table(material.results.random)
        if material.results.random
        else Missing("Fast pictures of random scenes", "bin/bench random --json report/results/random.json"),
        "devices": Table(
            ["backend", "device"], [list(entry) for entry in devices], "Devices that rendered the pictures of this section."
        ),
        "reasons": list(reasons),
    }
