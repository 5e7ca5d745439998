# SPDX-License-Identifier: Apache-2.0
"""Counts the decided comparisons of a study, at 5 % for all together: Student's t on the ratios of the runs, and Holm's
correction for their number, as in bench compare and duel."""

from __future__ import annotations

import math
import statistics
from typing import Any

LEVEL = 0.05
POINTS = 2000  # of the integral


def both_tails(t: float, freedom: int) -> float:
    """Returns the probability that |Student's t| is at least |t|. With t = sqrt(freedom) tan(x) the density is a power
    of the cosine."""

    def integral(begin: float) -> float:
        width = (math.pi / 2 - begin) / POINTS
        return width * sum(math.cos(begin + (k + 0.5) * width) ** (freedom - 1) for k in range(POINTS))

    return integral(math.atan(abs(t) / math.sqrt(freedom))) / integral(0)


def _p_greater(data: dict[str, Any], entry: dict[str, Any]) -> float:
    """Returns the p-value of one ratio, paired by round, if the runs' medians differed from 1 by chance; 1 unless it is
    above 1."""
    above, below = (
        {(s["run"], s["round"]): s["kernel"] for row in data["rows"] if row["name"] == entry[end] for s in row["samples"]}
        for end in ("numerator", "denominator")
    )
    runs: dict[int, list[float]] = {}
    for at in above.keys() & below.keys():
        runs.setdefault(at[0], []).append(above[at] / below[at])
    logs = [math.log(statistics.median(ratios)) for ratios in runs.values()]
    if len(logs) < 2 or statistics.mean(logs) <= 0:
        return 1
    error = statistics.stdev(logs) / math.sqrt(len(logs))
    return both_tails(statistics.mean(logs) / error, len(logs) - 1) if error > 0 else 0


def greater(data: dict[str, Any], entries: list[dict[str, Any]]) -> int:
    """Counts the ratios above 1, with Holm's correction."""
    p_values = sorted(_p_greater(data, entry) for entry in entries)
    missed = [k for k, p in enumerate(p_values) if p > LEVEL / (len(p_values) - k)]
    return missed[0] if missed else len(p_values)
