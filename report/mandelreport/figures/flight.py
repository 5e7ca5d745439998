# SPDX-License-Identifier: Apache-2.0
"""Figures of a flight: free space, the path, and measurements along it."""

import math

from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle, Rectangle

from ..blocks import Figure
from ..flight import FlightMap
from ..text import digits
from . import style

PLANES = [("x", "y", "z"), ("x", "z", "y")]


def _speeds(flight: FlightMap) -> list[float]:
    """Returns the camera's speed in hull sizes per second, for each frame but the first."""
    x, y, z = (flight.data[key] for key in "xyz")
    per_frame = flight.data["frames_per_second"] / flight.hull
    return [math.dist((x[i], y[i], z[i]), (x[i - 1], y[i - 1], z[i - 1])) * per_frame for i in range(1, len(x))]


def ground(flight: FlightMap) -> Figure:
    """Shows maps of the free balls, the gates, and the path with its passages, as seen along two axes."""
    figure, axes = style.panels(1, 2, 8, 4.6)
    figure.set_layout_engine("compressed")
    balls, gates = flight.data["balls"], flight.data["gates"]
    axis_of = {"x": 0, "y": 1, "z": 2}
    hull = flight.hull
    for axis, (right, up, along) in zip(axes[0], PLANES):
        a, b = axis_of[right], axis_of[up]
        # Balls overlap. Therefore they are pale, and the far balls are drawn first.
        near = sorted(balls, key=lambda ball: ball[axis_of[along]])
        axis.add_collection(
            PatchCollection(
                [Circle((ball[a], ball[b]), flight.data["safety"] * ball[3]) for ball in near],
                facecolor=style.SKY,
                edgecolor="#336688",
                linewidth=0.15,
                alpha=0.12,
                rasterized=True,
            )
        )
        shape = (
            Circle((0, 0), hull, fill=False, linestyle="--", linewidth=0.8)
            if flight.data["hull"]["shape"] == "sphere"
            else Rectangle((-hull, -hull), 2 * hull, 2 * hull, fill=False, linestyle="--", linewidth=0.8)
        )
        axis.add_patch(shape)
        axis.scatter(
            [g[a] for g in gates],
            [g[b] for g in gates],
            s=9,
            color="#333333",
            marker="x",
            linewidth=0.6,
            label=f"{flight.data['gate_count']} gates",
        )
        xs, ys = flight.data[right], flight.data[up]
        axis.plot(xs, ys, color="white", linewidth=2.2)
        axis.plot(xs, ys, color=style.RED, linewidth=1, label="path")
        passages = flight.data["passages"]
        axis.plot(
            [xs[i] for i in passages],
            [ys[i] for i in passages],
            linestyle="",
            marker="D",
            markersize=4,
            color=style.YELLOW,
            markeredgecolor="black",
            markeredgewidth=0.6,
            label=f"{len(passages)} passages",
        )
        axis.plot(xs[0], ys[0], linestyle="", marker="o", markersize=6, color=style.BLUE, label="start")
        axis.plot(xs[-1], ys[-1], linestyle="", marker="s", markersize=6, color="black", label="end")
        # Each map shows a square around the part of the path that is inside the hull. The approach is outside.
        inside = [i for i in range(len(xs)) if max(abs(flight.data[key][i]) for key in "xyz") <= hull] or range(len(xs))
        ranges = [(min(s), max(s)) for s in ([flight.data[key][i] for i in inside] for key in "xyz")]
        half = 0.6 * max(high - low for low, high in ranges)
        middle = [(ranges[k][0] + ranges[k][1]) / 2 for k in (a, b)]
        axis.set(
            aspect="equal",
            xlabel=right,
            ylabel=up,
            xlim=(middle[0] - half, middle[0] + half),
            ylim=(middle[1] - half, middle[1] + half),
        )
        axis.set_title(f"seen along {along}")
        axis.grid(visible=False)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8)
    return style.block(
        figure,
        f"Two maps of the flight through the {flight.fractal}, seen along z and along y: "
        f"{flight.data['ball_count']} free balls, {flight.data['gate_count']} gates, the path and its "
        f"{len(flight.data['passages'])} distinct passages.",
        f"{flight.fractal}, seed {flight.data['seed']}: {len(balls):,} of {flight.data['ball_count']:,} "
        "free balls (pale; those on and near the path), the gates, the path. Dashed: the hull. By symmetry one part of space "
        "represents all of it; the balls and the path lie in that part.",
    )


def over_time(flight: FlightMap) -> Figure:
    """Shows the clearance, the speed, the camera's step divided by the clearance, and the turn, frame by frame."""
    seconds = flight.seconds
    clearance = [100 * c / flight.hull for c in flight.data["clearance"]]
    speed = _speeds(flight)
    per_frame = flight.hull / flight.data["frames_per_second"]
    steps = [
        v * per_frame / max(min(a, b), 1e-300)
        for v, a, b in zip(speed, flight.data["clearance"], flight.data["clearance"][1:])
    ]
    turn = flight.data["turn"]
    figure, axes = style.panels(4, 1, 8, 6.6, sharex=True)
    plots = [
        ("clearance\n[% of hull size]", seconds, clearance, True),
        ("speed\n[hull sizes / s]", seconds[1:], speed, True),
        ("step /\nclearance", seconds[1:], steps, False),
        ("turn\n[degrees / frame]", seconds, turn, False),
    ]
    for number, (title, x, y, logarithmic) in enumerate(plots):
        axis = axes[number][0]
        axis.plot(x, y, color=style.COLOURS[0], linewidth=0.7)
        axis.set_ylabel(title)
        if logarithmic:
            axis.set_yscale("log")
        for passage in flight.data["passages"]:
            axis.axvline(seconds[passage], color=style.RED, linewidth=0.7, linestyle=":")
    axes[3][0].set_xlabel("time [s]")
    axes[3][0].set_xlim(0, seconds[-1])
    return style.block(
        figure,
        f"Four curves over {digits(seconds[-1])} seconds of the {flight.fractal}'s flight: clearance from "
        f"{digits(min(clearance))} to {digits(max(clearance))} % of the hull size; speed up to "
        f"{digits(max(speed))} hull sizes per second; steps up to {digits(max(steps))} of the clearance; turns up "
        f"to {digits(max(turn))} degrees per frame.",
        f"{flight.fractal}: clearance, speed, step over clearance and turn, by frame. Dotted: the narrowest "
        "places of distinct passages.",
    )
