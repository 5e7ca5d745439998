# SPDX-License-Identifier: Apache-2.0
"""The film, a frame and its summary; flights: maps of free space, paths over time, audits and studies."""

import math
from pathlib import Path
from typing import Any

from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle, Rectangle
from PIL import Image

from .. import charts
from ..blocks import Figure, Missing, Output, data_uri, seen
from ..flight import FlightMap
from ..pictures import ROOT, encoded
from ..text import digits
from . import Material

GROUND = "the path (red) stays within the free balls (pale) and leads from passage to passage (diamonds)."
MAP_COMMAND = "bin/flythrough plan path.json --fractal bulb --map results/map_bulb.json"
PLANES = [(0, 1, 2), (0, 2, 1)]  # the axes to the right, up, and along the view
SHEET_WIDTH = 1600  # pixels
SHEET_QUALITY = 80


def _ground(flight: FlightMap) -> Figure:
    """Shows maps of the free balls, the gates, and the path with its passages, as seen along two axes."""
    figure, axes = charts.panels(1, 2, 8, 4.6)
    figure.set_layout_engine("compressed")
    data, hull = flight.data, flight.hull
    balls, gates, passages, path = data["balls"], data["gates"], data["passages"], [data[key] for key in "xyz"]
    outline: dict[str, Any] = {"fill": False, "linestyle": "--", "linewidth": 0.8}
    # Each map shows a square around the part of the path that is inside the hull. The approach is outside.
    inside = [place for place in zip(*path) if max(map(abs, place)) <= hull] or list(zip(*path))
    ranges = [(min(series), max(series)) for series in zip(*inside)]
    half = 0.6 * max(high - low for low, high in ranges)
    for axis, (a, b, along) in zip(axes[0], PLANES):
        # Balls overlap. Therefore they are pale, and the far balls are drawn first.
        circles = [Circle((ball[a], ball[b]), data["safety"] * ball[3]) for ball in sorted(balls, key=lambda ball: ball[along])]
        pale = PatchCollection(circles, facecolor=charts.SKY, edgecolor="#336688", linewidth=0.15, alpha=0.12, rasterized=True)
        axis.add_collection(pale)
        box = Rectangle((-hull, -hull), 2 * hull, 2 * hull, **outline)
        axis.add_patch(Circle((0, 0), hull, **outline) if data["hull"]["shape"] == "sphere" else box)
        label = f"{data['gate_count']} gates"
        axis.scatter([g[a] for g in gates], [g[b] for g in gates], s=9, color="#333333", marker="x", linewidth=0.6, label=label)
        xs, ys = path[a], path[b]
        axis.plot(xs, ys, color="white", linewidth=2.2)
        axis.plot(xs, ys, color=charts.RED, linewidth=1, label="path")
        places, label = ([xs[i] for i in passages], [ys[i] for i in passages]), f"{len(passages)} passages"
        axis.plot(*places, linestyle="", marker="D", markersize=4, color=charts.YELLOW, markeredgecolor="black", markeredgewidth=0.6, label=label)
        axis.plot(xs[0], ys[0], linestyle="", marker="o", markersize=6, color=charts.BLUE, label="start")
        axis.plot(xs[-1], ys[-1], linestyle="", marker="s", markersize=6, color="black", label="end")
        limits = [(sum(ranges[k]) / 2 - half, sum(ranges[k]) / 2 + half) for k in (a, b)]
        axis.set(aspect="equal", xlabel="xyz"[a], ylabel="xyz"[b], xlim=limits[0], ylim=limits[1], title=f"seen along {'xyz'[along]}")
        axis.grid(visible=False)
    charts.legend(figure, axes[0][0])
    return charts.block(
        figure,
        f"Two maps of the flight through the {flight.fractal}, seen along z and along y: {data['ball_count']} free balls, "
        f"{data['gate_count']} gates, the path and its {len(passages)} distinct passages.",
        f"{flight.fractal}, seed {data['seed']}: {len(balls):,} of {data['ball_count']:,} free balls (pale; those on and near the path), "
        "the gates, the path. Dashed: the hull. By symmetry one part of space represents all of it; the balls and the path lie in that part.",
    )


def _over_time(flight: FlightMap) -> Figure:
    """Shows the clearance, the speed, the camera's step divided by the clearance, and the turn, frame by frame."""
    data, seconds, clear = flight.data, flight.seconds, flight.data["clearance"]
    places = list(zip(data["x"], data["y"], data["z"]))
    moved = list(map(math.dist, places, places[1:]))
    clearance = [100 * c / flight.hull for c in clear]
    speed = [step * data["frames_per_second"] / flight.hull for step in moved]
    steps = [step / max(min(a, b), 1e-300) for step, a, b in zip(moved, clear, clear[1:])]
    figure, axes = charts.panels(4, 1, 8, 6.6, sharex=True)
    plots = [
        ("clearance\n[% of hull size]", clearance, "log"),
        ("speed\n[hull sizes / s]", speed, "log"),
        ("step /\nclearance", steps, "linear"),
        ("turn\n[degrees / frame]", data["turn"], "linear"),
    ]
    for (axis,), (title, values, scale) in zip(axes, plots):
        axis.plot(seconds[-len(values) :], values, color=charts.BLUE, linewidth=0.7)
        axis.set(ylabel=title, yscale=scale)
        for passage in data["passages"]:
            axis.axvline(seconds[passage], color=charts.RED, linewidth=0.7, linestyle=":")
    axes[3][0].set(xlabel="time [s]", xlim=(0, seconds[-1]))
    return charts.block(
        figure,
        f"Four curves over {digits(seconds[-1])} seconds of the {flight.fractal}'s flight: clearance from "
        f"{digits(min(clearance))} to {digits(max(clearance))} % of the hull size; speed up to "
        f"{digits(max(speed))} hull sizes per second; steps up to {digits(max(steps))} of the clearance; turns up "
        f"to {digits(max(data['turn']))} degrees per frame.",
        f"{flight.fractal}: clearance, speed, step over clearance and turn, by frame. Dotted: the narrowest places of distinct passages.",
    )


def _sheet(path: Path) -> Figure:
    """Returns a contact sheet, scaled down for the page."""
    with Image.open(path) as image:
        small = image.convert("RGB")
        if small.width > SHEET_WIDTH:
            small = small.resize((SHEET_WIDTH, round(small.height * SHEET_WIDTH / small.width)), Image.Resampling.LANCZOS)
    return Figure(
        encoded(small, "jpeg", quality=SHEET_QUALITY, optimize=True),
        f"Contact sheet of the film ({path.stem}): small frames in order, row by row, from outside the fractal into its holes.",
        f"Frames of the film: {path.stem}.",
        see="row by row, the camera approaches from outside, enters a hole and continues from hole to hole.",
    )


def _frame() -> Figure:
    """Returns a frame of the film, which tools/gallery renders."""
    return Figure(
        data_uri("image/jpeg", (ROOT / "docs" / "pictures" / "flight.jpg").read_bytes()),
        "A frame of the film: inside the Mandelbulb, between its walls.",
        "Frame 2700 of the Mandelbulb's flight with seed 1, rendered at 1920 x 1080 (make gallery).",
    )


def film(material: Material) -> dict[str, Any]:
    results = material.results
    promises = [kept for audit in results.audits for kept in audit.promises]
    return {
        "frame": _frame(),
        "cost": material.answers.film(),
        "films": results.films or [Missing("The film's summary", "bin/flythrough film --output video.mp4 --summary results/film.json")],
        "map": seen(_ground(results.maps[-1]), GROUND) if results.maps else Missing("The map and the path", MAP_COMMAND),
        "sheets": [_sheet(path) for path in results.contact_sheets] or [Missing("The contact sheet", "make contact-sheet")],
        "promises": len(promises),
        "kept": sum(promises),
        "flights": len(results.audits),
    }


def flights(material: Material) -> dict[str, Any]:
    results = material.results
    # The last flight's map of balls appears in the main part.
    maps = [(_ground(m) if m is not results.maps[-1] else None, _over_time(m), m) for m in results.maps]
    return {
        "maps": maps,
        "no_maps": Missing("The map, the path and its measurements", MAP_COMMAND),
        "audits": [audit.table for audit in results.audits]
        or [Missing("The audit", "bin/flythrough audit path.json --json results/flight_bulb.json")],
        "studies": [Output(study) for study in results.flight_studies] or [Missing("The study of seeds", "make flight-study")],
    }
