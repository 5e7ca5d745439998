# SPDX-License-Identifier: Apache-2.0
"""How the pixels of a film are distributed: ranks, threads, warps and lanes."""

import itertools

from matplotlib.colors import ListedColormap

from ..blocks import Figure
from . import style

NONE = 7  # the value of a cell that waits; other values are indices of colours
LANES, TIMES = 8, 14  # columns and rows of the last two panels
LENGTHS = (5, 3, 8, 4, 6, 2, 7, 3, 4, 6, 2, 5, 9, 3, 4)  # steps of successive rays, invented


def _lanes(replaced: bool) -> list[list[int]]:
    """Returns the ray of each lane at each time. `replaced`: a lane whose ray has ended takes the next ray at once.
    Otherwise it waits until the rays of all lanes have ended."""
    rays = enumerate(itertools.cycle(LENGTHS))
    lanes = [(0, 0)] * LANES  # ray, steps that remain
    rows = []
    for _ in range(TIMES):
        if replaced or not any(left for _, left in lanes):
            lanes = [lane if lane[1] else next(rays) for lane in lanes]
        rows.append([ray % NONE if left else NONE for ray, left in lanes])
        lanes = [(ray, max(0, left - 1)) for ray, left in lanes]
    return rows


def pixels() -> Figure:
    """Shows five panels, from the frames of a film to the lanes of a register or a warp."""
    segments = (0, 1, 2, 0, 1, 0, 2, 1)  # the rank that renders each segment
    panels = [
        ("frames of a film", "a colour: an MPI rank,\nsegment by segment", [[segments[2 * j + i // 3] for i in range(6)] for j in range(4)]),
        ("tiles of a frame", "a colour: a thread\nof OpenMP", [[5 * (8 * j + i) // 3 % 4 for i in range(8)] for j in range(6)]),
        ("pixels of a tile", "a colour: a warp\nor a pack of lanes", [[(2 * (j // 4) + i // 8) % NONE for i in range(16)] for j in range(16)]),
        ("lanes of a pack", "time goes down; an\nended ray is replaced", _lanes(True)),
        ("threads of a warp", "white: waits for the\nwarp's longest ray", _lanes(False)),
    ]
    figure, [axes] = style.panels(1, len(panels), 7.2, 2.1)
    colours = ListedColormap([*style.COLOURS[:NONE], "white"])
    for axis, (title, note, cells) in zip(axes, panels):
        axis.pcolormesh(cells, cmap=colours, vmin=-0.5, vmax=NONE + 0.5, edgecolors="white", linewidth=0.5)
        axis.set(box_aspect=1, xticks=[], yticks=[])
        axis.set_title(title, fontsize=8.5)
        axis.set_xlabel(note, fontsize=8)
        axis.grid(visible=False)
        axis.invert_yaxis()
    return style.block(
        figure,
        "Five panels: ranks take segments of a film's frames; threads take tiles of a frame; warps and packs take neighbouring pixels of a "
        "tile; the lanes of a pack replace ended rays; the threads of a warp wait for the longest ray.",
        "From pixels to lanes. A segment has 60 frames (3 here), a tile 16 x 16 pixels, a warp 8 x 4 pixels; a GPU takes the warps of a "
        "whole band at once. The last two panels show eight lanes or threads over time, with invented lengths of rays.",
        name="pixels",
    )
