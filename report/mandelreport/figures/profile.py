# SPDX-License-Identifier: Apache-2.0
"""Time per stage of a picture."""

from statistics import median

from matplotlib.patches import Patch

from ..bench import Bench
from ..blocks import Figure
from ..text import percent
from . import style

STAGES = ["begin", "march", "refine", "normal", "shade", "output"]


def stage_medians(bench: Bench) -> dict[tuple[str, str, str], dict[str, float]]:
    """Returns the median seconds of each stage, by fractal, precision and mode."""
    found: dict[tuple[str, str, str], dict[str, float]] = {}
    for stage in bench.data["stages"]:
        key = (stage["fractal"], stage["precision"], stage["mode"])
        found.setdefault(key, {})[stage["stage"]] = median(stage["seconds"])
    return found


def operation_shares(bench: Bench) -> dict[tuple[str, str, str], dict[str, float]]:
    """Returns the fraction of the counted operations that each stage takes, for the official scenes, by fractal,
    precision and mode."""
    found = {}
    for count in bench.data["counts"]:
        if count["setting"]["view"] != "official":
            continue
        sums = {stage: sum(kinds.values()) for stage, kinds in count["stages"].items()}
        total = sum(sums.values()) or 1
        found[(count["fractal"], count["precision"], count["mode"])] = {s: v / total for s, v in sums.items()}
    return found


def profile(bench: Bench) -> Figure | None:
    """Shows stacked bars of the stages' fractions of the time. Below each is a bar of their fractions of the counted
    operations."""
    times = stage_medians(bench)
    if not times:
        return None
    operations = operation_shares(bench)
    figure, [[axis]] = style.panels(1, 1, 8, 0.9 + 0.5 * len(times))
    labels, said = [], []
    for number, (key, stages) in enumerate(times.items()):
        total = sum(stages.get(stage, 0) for stage in STAGES)
        bars = [("time", {stage: stages.get(stage, 0) / total for stage in STAGES})]
        if key in operations:
            bars.append(("operations", operations[key]))
        for k, (what, shares) in enumerate(bars):
            left = 0.0
            for s, stage in enumerate(STAGES):
                share = 100 * shares.get(stage, 0)
                axis.barh(2.5 * number + k, share, 0.9, left=left, **style.look(s))
                if share > 6:
                    axis.text(
                        left + share / 2,
                        2.5 * number + k,
                        f"{share:.0f}",
                        ha="center",
                        va="center",
                        fontsize=7,
                        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
                    )
                left += share
            labels.append((2.5 * number + k, f"{', '.join(key)}: {what}" if k == 0 else what))
        most = max(STAGES, key=lambda stage: stages.get(stage, 0))
        said.append(f"{', '.join(key)}: {most} {percent(stages[most] / total, 0)} of the time")
    axis.set_yticks([at for at, _ in labels], [text for _, text in labels], fontsize=7)
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.set(xlabel="fraction [%]", xlim=(0, 100))
    handles = [Patch(label=stage, **style.look(s)) for s, stage in enumerate(STAGES)]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return style.block(
        figure,
        "Stacked bars of the stages' fractions. " + "; ".join(said) + ".",
        "Time of a picture by stage, on one core (openmp), and its counted operations by stage. In fast mode, begin includes "
        "the cones.",
        name="profile",
    )
