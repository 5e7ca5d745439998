# SPDX-License-Identifier: Apache-2.0
"""The result of `bench random`: error of fast pictures of random scenes against the canonical ones."""

from __future__ import annotations

from typing import Any

from .blocks import Table


def _range(values: list[float], places: int) -> str:
    return f"{min(values):.{places}f} – {max(values):.{places}f}"


def random_table(results: list[dict[str, Any]]) -> Table:
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
        "Fast pictures of random scenes compared with the reference's canonical ones (bench random): pixels that differ visibly, and "
        "pixels that hit the surface in one picture only. Limited by float: in exact mode, too, more than 2 % of the pixels differ "
        "between float and double.",
        [3, 4, 5, 6, 7, 8],
    )
