# SPDX-License-Identifier: Apache-2.0
"""Section 2: the timings of every machine, and the sweeps."""

from __future__ import annotations

import json
import subprocess
from typing import Any

from ..backends import Backends
from ..bench import Bench, read_portability
from ..blocks import Block, Missing, Table
from ..errors import InputError
from ..figures import portability, sweeps, timings
from ..text import digits, interval_ms, ms, percent, where
from . import Material

# study, axis, what it shows (y), caption
SWEEPS = [
    (
        "resolution",
        "picture [pixels]",
        "rate",
        "Pixels a second over the picture's size: where a line is flat, twice the pixels take twice the time. Wide ones have "
        "more background.",
    ),
    (
        "threads",
        "threads",
        "speed-up",
        "Speed-up over one thread, with its interval. Twice the processor's threads is the last point.",
    ),
    (
        "frames",
        "pictures from one fresh renderer",
        "ms",
        "Wall time a picture, context and build included: what opening a device costs, and how many pictures pay for it.",
    ),
    ("packs", "pixels at once on a core", "ms", "Kernel time over the pixels that a core computes at once."),
    (
        "tiles",
        "tiles that a thread takes at once",
        "ms",
        "Kernel time over the tiles of 16 x 16 pixels that a thread takes at once.",
    ),
    ("iterations", "limit of iterations", "ms", "Kernel time over the distance estimator's limit of iterations."),
    ("detail", "detail level D", "ms", "Kernel time over the detail level: a surface is hit where DE < 10^D t."),
]
Y_TITLES = {"rate": "Mpixel/s", "speed-up": "speed-up", "ms": "time [ms]"}


def _bench_table(bench: Bench, fractal: str) -> Table:
    rows = []
    for row in bench.rows:
        if row.fractal not in (fractal, "all") or (row.fractal == "all" and fractal != bench.rows[0].fractal):
            continue
        head = [where(row), row.precision, row.mode]
        if not row.timed:
            why = row.unavailable or row.failure or row.proof["text"]
            rows.append([*head, *["–"] * 6, why])
            continue
        figures = row.figures
        rate = figures["operations_per_second"]
        rows.append(
            [
                *head,
                ms(row.kernel.median),
                interval_ms(row.kernel),
                ms(row.wall.median),
                "–" if rate is None else digits(rate / 1e9),
                percent(figures["share_of_peak"]),
                "–" if figures["speed_up"] is None else digits(figures["speed_up"]),
                row.proof["text"] or "yardstick",
            ]
        )
    size = bench.rows[0].setting
    return Table(
        ["backend", "number", "mode", "kernel ms", "95 % interval", "wall ms", "GFLOP/s", "of peak", "speed-up", "picture"],
        rows,
        f"{fractal}, {size['width']} x {size['height']} pixels.",
        [3, 4, 5, 6, 7, 8],
    )


def _portability(material: Material) -> list[dict[str, Any]]:
    """The metric over all platforms: from a file, from the one result there is, or from bench over several."""
    results, standard = material.results, material.results.machines()
    if results.portability is not None or not standard:
        return results.portability or []
    program = material.studio.render.with_name("bench")
    if len(standard) == 1 or not program.exists():
        return standard[0].data["portability"]
    material.work.mkdir(parents=True, exist_ok=True)
    target = material.work / "portability.json"
    run = subprocess.run(
        [program, "portability", *(bench.path for bench in standard), "--json", target],
        capture_output=True,
        text=True,
        check=False,
    )
    if run.returncode != 0:
        raise InputError(f"{program}: {(run.stderr.strip().splitlines() or ['it failed'])[-1]}")
    return read_portability(str(target), json.loads(target.read_text(encoding="utf-8")))


def _portability_table(entries: list[dict[str, Any]]) -> Table | None:
    rows = []
    for entry in entries:

        def with_interval(key: str, entry: dict[str, Any] = entry) -> str:
            interval = entry[f"{key}_interval"]
            return digits(entry[key]) + (f" ({digits(interval[0])} – {digits(interval[1])})" if interval else "")

        rows.append(
            [
                entry["fractal"],
                entry["precision"],
                entry["mode"],
                entry["application"],
                str(len(entry["platforms"])),
                with_interval("by_application_efficiency"),
                with_interval("by_share_of_peak"),
            ]
        )
    if not rows:
        return None
    return Table(
        ["fractal", "number", "mode", "backend", "platforms", "PP by application", "PP by share of peak"],
        rows,
        "Pennycook's performance portability: by application efficiency (the best backend's time on the platform over "
        "this one's) and by architectural efficiency (share of the measured peak), with bootstrap intervals.",
        [4, 5, 6],
    )


def _machine(bench: Bench, backends: Backends) -> dict[str, Any]:
    """Everything of one result file of the standard study."""
    fractals = [fractal for fractal in dict.fromkeys(row.fractal for row in bench.rows) if fractal != "all"]
    settings = [row.setting for row in bench.rows if row.timed]
    peaks = Table(
        ["platform", "backend", "number", "multiply-add peak [GFLOP/s]"],
        [
            [p["platform"], p["backend"], p["precision"], digits(p["operations_per_second"] / 1e9)]
            for p in bench.data["peaks"]
        ],
        "Peaks, measured; a platform's is the highest that any backend reaches.",
        [3],
    )
    return {
        "name": bench.name,
        "machine": bench.machine,
        "sizes": ", ".join(dict.fromkeys(f"{s['width']} x {s['height']} pixels" for s in settings)),
        "launches": bench.data["launches"],
        "instructions": ", ".join(
            dict.fromkeys(row["instruction_set"] for row in bench.data["rows"] if row["backend"] == backends.host and row["figures"])
        ),
        "warnings": bench.data["warnings"],
        "tables": [_bench_table(bench, fractal) for fractal in fractals],
        "bars": timings.kernel_bars(bench, backends),
        "double": timings.ratios(
            bench,
            backends,
            "double_to_float",
            "double / float, kernel time",
            "Float against double: how many times longer double takes, round by round, with 95 % intervals.",
        ),
        "box_to_bulb": timings.ratios(
            bench,
            backends,
            "mandelbox_to_mandelbulb",
            "Mandelbox / Mandelbulb, kernel time",
            "Box against bulb: how many times longer the Mandelbox's official scene takes, round by round.",
        ),
        "peak": timings.share_of_peak(bench, backends),
        "peaks": peaks,
    }


def _sweeps(material: Material) -> list[tuple[str, list[Block]]]:
    found: list[tuple[str, list[Block]]] = []
    for study, x_title, y, caption in SWEEPS:
        blocks: list[Block] = []
        for bench in material.results.study(study):
            about = f"{caption} {' and '.join(bench.values('mode')).capitalize()} mode; {bench.machine}."
            figure = sweeps.sweep(bench, x_title, Y_TITLES[y], about, y, ideal=study == "threads")
            if figure:
                blocks.append(figure)
        command = f"bin/bench --study {study} --json report/results/{study}.json"
        found.append((study, blocks or [Missing(f"The study {study}", command)]))
    return found


def section(material: Material) -> dict[str, Any]:
    metric = _portability(material)
    backends = material.backends
    machines = [_machine(bench, backends) for bench in material.results.study("standard")]
    ablations = [figure for bench in material.results.study("ablation") if (figure := sweeps.ablation(bench))]
    return {
        "machines": machines,
        "missing": Missing("The timings", "make bench"),
        "together": timings.machines(material.results.machines()),
        "portability": _portability_table(metric),
        "cascade": portability.cascade(metric, backends),
        "loop_mix": material.results.loop_mix,
        "no_loop_mix": Missing("What the estimators' loops consist of", "make loop-mix"),
        "sweeps": _sweeps(material),
        "ablation": ablations
        or [Missing("The ablation", "bin/bench --study ablation --json report/results/ablation.json")],
    }
