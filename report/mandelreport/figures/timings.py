# SPDX-License-Identifier: Apache-2.0
"""Figures of the standard study: times relative to the scalar kernel, double over float, shares of the peak."""

import itertools

from matplotlib.patches import Patch

from ..backends import Backends
from ..bench import SCALAR, Bench, Times
from ..blocks import Figure
from ..models import label, ranked, with_scalar
from ..text import digits, ms, percent, plain, where
from . import style


def over_scalar(bench: Bench, backends: Backends) -> Figure | None:
    """Shows the time of every backend divided by the scalar kernel's time, fastest first, in a panel for each fractal
    and mode."""
    rows = with_scalar(bench, backends.reference)
    if not any(row.sweep_value == SCALAR for row in rows):
        return None
    names = ranked(rows)
    fractals, modes = bench.values("fractal"), bench.values("mode")
    figure, axes = style.panels(len(modes), len(fractals), 8, (0.7 + 0.2 * len(names)) * len(modes), sharex=True, sharey=True)
    said = []
    for row in rows:
        value = 1 if row.sweep_value == SCALAR else row.figures["over_scalar"]
        times = Times(value, row.figures["over_scalar_interval"]).inverse()
        axis = axes[modes.index(row.mode)][fractals.index(row.fractal)]
        at = names.index(label(row)) + (-0.15 if row.precision == "double" else 0.15)
        look = style.line(backends.number_of(row.backend)) | {"linestyle": "", "fillstyle": "full" if row.precision == "double" else "none"}
        style.point(axis, times, at, **look)
        said.append(f"{row.fractal}, {row.precision}, {row.mode}, {label(row)}: {digits(times.median)}")
    for i, j in itertools.product(range(len(modes)), range(len(fractals))):
        axes[i][j].axvline(1, color="black", linewidth=0.8)
        axes[i][j].set(xscale="log", title=f"{fractals[j]}, {modes[i]}")
        axes[i][j].xaxis.set_major_formatter(lambda x, _: plain(x))
        axes[i][j].set_yticks(range(len(names)), names, fontsize=8)
        axes[i][j].grid(axis="y", visible=False)
    axes[0][0].invert_yaxis()
    figure.supxlabel("time / time of the scalar kernel, logarithmic", fontsize=9)
    return style.block(
        figure,
        "Points with intervals: time over the scalar kernel's. " + "; ".join(said) + ".",
        "Wall time of one picture over that of the same kernel as plain scalar C++ (the line at 1), with 95 % intervals, fastest backend "
        "first. Filled marks: double; open marks: float. The scalar kernel runs on as many threads as the processor has, backends marked "
        "(1 thread) on one; with two threads, twice the time is then the same speed per thread.",
    )


def double_to_float(bench: Bench, backends: Backends) -> Figure | None:
    """Shows the kernel time in double divided by that in float, with a line for each backend and a panel for each
    fractal."""
    found = [(bench.named(ratio["numerator"]), Times.of(ratio["ratio"])) for ratio in bench.ratios("double_to_float")]
    if not found:
        return None
    fractals = list(dict.fromkeys(row.fractal for row, _ in found))
    names = backends.order(label(row) for row, _ in found)
    figure, axes = style.panels(1, len(fractals), 8, 1.0 + 0.2 * len(names), sharex=True, sharey=True)
    said = []
    for row, times in found:
        exact = row.mode == "exact"
        look = style.line(backends.number_of(row.backend)) | {"linestyle": "", "fillstyle": "full" if exact else "none"}
        style.point(axes[0][fractals.index(row.fractal)], times, names.index(label(row)) + (-0.15 if exact else 0.15), **look)
        said.append(f"{row.fractal}, {row.mode}, {label(row)}: {digits(times.median)}")
    for axis, fractal in zip(axes[0], fractals):
        axis.axvline(1, color="black", linewidth=0.8)
        axis.set(title=fractal, xlim=(0, None))
        axis.set_yticks(range(len(names)), names, fontsize=8)
        axis.grid(axis="y", visible=False)
    axes[0][0].invert_yaxis()
    figure.supxlabel("time in double / time in float", fontsize=9)
    return style.block(
        figure,
        "Points with intervals: time in double over that in float. " + "; ".join(said) + ".",
        f"Kernel time in double over that in float, round by round, with 95 % intervals ({bench.name}). Filled marks: exact mode; open marks: "
        "fast mode.",
    )


def share_of_peak(bench: Bench, backends: Backends) -> Figure | None:
    """Shows counted operations per second as a share of the platform's measured multiply-add peak."""
    rows = [row for row in bench.rows if row.timed and row.figures["share_of_peak"] is not None]
    if not rows:
        return None
    fractals = list(dict.fromkeys(row.fractal for row in rows))
    groups = list(dict.fromkeys((row.precision, row.mode) for row in rows))
    figure, axes = style.panels(1, len(fractals), 8, 2.9, sharey=True)
    said = []
    for j, fractal in enumerate(fractals):
        axis = axes[0][j]
        of_fractal = [row for row in rows if row.fractal == fractal]
        names = backends.order([label(row) for row in of_fractal])
        width = 0.8 / len(names)
        for row in of_fractal:
            x = groups.index((row.precision, row.mode)) + (names.index(label(row)) - (len(names) - 1) / 2) * width
            share = 100 * row.figures["share_of_peak"]
            axis.bar(x, share, width, **style.look(backends.number_of(row.backend)))
        best = max(of_fractal, key=lambda row: row.figures["share_of_peak"])
        said.append(
            f"{fractal}: at most {percent(best.figures['share_of_peak'])}, {label(best)}, {best.precision}, {best.mode}"
        )
        axis.set_xticks(range(len(groups)), ["\n".join(group) for group in groups])
        axis.set_title(fractal)
        axis.grid(axis="x", visible=False)
        if j == 0:
            axis.set_ylabel("share of the peak [%]")
            handles = [Patch(label=name, **style.look(backends.number_of(name.split()[0]))) for name in names]
            figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=8)
    return style.block(
        figure,
        "Bar charts of the share of the measured peak. " + "; ".join(said) + ".",
        "Counted operations per second as a share of the platform's measured multiply-add peak, the flat roof of a roofline "
        "plot. The march reads no memory, so the slanted roof (memory bandwidth) does not apply.",
    )


def machines(benches: list[Bench]) -> Figure | None:
    """Shows the speed of each machine's fastest backend, for each fractal, precision and mode."""
    if len(benches) < 2:
        return None
    kinds = list(dict.fromkeys(row.kind for bench in benches for row in bench.fastest()))
    figure, [[axis]] = style.panels(1, 1, 8, 1.1 + 0.2 * len(kinds))
    said = []
    for number, bench in enumerate(benches):
        best = bench.fastest()
        rates = [row.figures["pixels_per_second"] / 1e6 for row in best]
        axis.plot(rates, [kinds.index(row.kind) for row in best], label=bench.machine, **style.line(number) | {"linestyle": ""})
        said += [f"{bench.machine}: {' '.join(row.kind)}: {where(row)}, {ms(row.kernel.median)} ms" for row in best]
    axis.set_yticks(range(len(kinds)), [", ".join(kind) for kind in kinds], fontsize=8)
    axis.invert_yaxis()
    axis.set(xlabel="Mpixel/s, fastest backend", xlim=(0, None))
    axis.grid(axis="y", visible=False)
    figure.legend(loc="outside upper center", fontsize=8)
    return style.block(
        figure,
        "Points: the fastest backend's rate on each machine. " + "; ".join(said) + ".",
        "All machines: pixels per second of the fastest backend.",
    )
