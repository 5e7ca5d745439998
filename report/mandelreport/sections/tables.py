# SPDX-License-Identifier: Apache-2.0
"""Tables of all results of the standard study. Each result has a column, named by its letter in the main part."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from typing import Any

from ..bench import Bench, Row
from ..blocks import Missing, Table
from ..errors import InputError
from ..figures import portability
from ..models import label
from ..results import checked
from ..text import digits, ms, percent, with_interval
from . import Material
from .why import factor_table


def time_cell(row: Row | None) -> str:
    """Formats the kernel time and its interval in ms."""
    if row is None or not row.timed:
        return "–"
    return with_interval(row.kernel.median, row.kernel.interval, ms)


def quotient_cell(row: Row, key: str) -> str:
    """Formats a speed-up with its interval. A baseline's speed-up over itself has no interval."""
    value = row.figures[key]
    if value is None:
        return "–"
    return "1" if value == 1 else with_interval(value, row.figures[f"{key}_interval"])


def _columns(material: Material, cell: Callable[[Bench, Row], str], caption: str) -> Table | None:
    """Returns a table with a line for each fractal, precision, mode and backend, and a column for each result. Leaves
    out empty lines."""
    benches = material.results.study("standard")
    found: dict[tuple[str, ...], dict[str, str]] = {}
    for bench in benches:
        for row in bench.all_rows:
            if row.fractal != "all":
                name = label(row)
                text = cell(bench, row) if row.timed else "–" if row.unavailable else "FAILED"
                found.setdefault((*row.kind, name), {})[bench.name] = text
    fractals = dict.fromkeys(key[0] for key in found)
    order = (*fractals, "double", "float", "exact", "fast", *material.backends.names)

    def place(key: tuple[str, ...]) -> list[int]:
        words = [word.split()[0].removesuffix("-scalar") for word in key]
        return [order.index(word) if word in order else len(order) for word in words]

    lines = [
        [*key, *(cells.get(bench.name, "") for bench in benches)]
        for key, cells in sorted(found.items(), key=lambda item: (place(item[0]), item[0]))
        if set(cells.values()) - {"–"}
    ]
    if not lines:
        return None
    letters = [material.letter(bench.name) for bench in benches]
    return Table(["fractal", "precision", "mode", "backend", *letters], lines, caption, list(range(4, 4 + len(letters))))


def _reasons(material: Material) -> list[str]:
    """Returns the distinct reasons why rows were not timed."""
    rows = [row for bench in material.results.study("standard") for row in bench.rows if not row.timed]
    return list(dict.fromkeys(row.unavailable or row.failure or f"{row.name}: {row.verification['text']}" for row in rows))


def _peaks(material: Material) -> Table | None:
    benches = material.results.study("standard")
    found: dict[tuple[str, str], dict[str, str]] = {}
    for bench in benches:
        for peak in bench.data["peaks"]:
            rate = digits(peak["operations_per_second"] / 1e9)
            found.setdefault((peak["backend"], peak["precision"]), {}).setdefault(bench.name, rate)
    rows = [[*key, *(cells.get(bench.name, "–") for bench in benches)] for key, cells in found.items()]
    headers = ["backend", "precision", *(material.letter(bench.name) for bench in benches)]
    caption = "Measured multiply-add peaks [GFLOP/s]; a platform's peak is the highest that any backend reaches."
    return Table(headers, rows, caption, list(range(2, len(headers)))) if rows else None


def _portability(material: Material) -> list[dict[str, Any]]:
    """Returns Pennycook's metric over all platforms: from a file of `bench portability` if the results have one, else
    from the only machine's result, else from a run of `bench portability` over the machines' results."""
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
        raise InputError(f"{program}: {(run.stderr.strip().splitlines() or ['failed without a message'])[-1]}")
    return checked(str(target), json.loads(target.read_text(encoding="utf-8")), "portability")


def _portability_table(entries: list[dict[str, Any]], missing: dict[str, list[str]]) -> Table | None:
    """Returns a table of Pennycook's metric for the backends that were measured on all platforms. `missing`: for each
    other backend, the platforms on which it was not measured."""
    platforms = dict.fromkeys(on["platform"] for entry in entries for on in entry["platforms"])
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
        ["fractal", "precision", "mode", "backend", "platforms", "PP by application", "PP by share of peak"],
        rows,
        "Pennycook's performance portability (PP): by application efficiency (the best backend's time on the platform over this "
        "one's; the backend that is fastest everywhere has 1) and by architectural efficiency (share of the measured peak), with "
        f"intervals by generalized pivots (Weerahandi), over H = {{{', '.join(platforms)}}}. 0: unavailable or a wrong picture "
        "on one of H." + "".join(f" {name} was not measured on {' and '.join(without)} and has no value." for name, without in missing.items()),
        [4, 5, 6],
    )


def _simd_widths(material: Material) -> Table | None:
    """Returns the speed-up of the host's packs over the scalar kernel, by SIMD width, from sweeps that have both."""
    rows = [
        [bench.name, *row.kind, row.value, ms(row.wall.median), quotient_cell(row, "over_scalar")]
        for bench in material.results.study("simd-widths")
        for row in bench.timed(backend=material.backends.host)
        if row.figures["over_scalar"] is not None
    ]
    headers = ["file", "fractal", "precision", "mode", "pixels at once", "wall ms", "over scalar"]
    return Table(headers, rows, "Speed-up of packs over the scalar kernel on the same threads.", [4, 5, 6]) if rows else None


def _lines_of_code(divergence: dict[str, Any]) -> Table:
    rows = [
        [m["backend"], str(m["lines"]), str(m["lines_of_job"]), str(m["lines_of_kernel"]), digits(nearest, 2), neighbour]
        for m in divergence["models"]
        for nearest, neighbour in [min((d, name) for name, d in m["distances"].items() if name != m["backend"])]
    ]
    return Table(
        ["backend", "own lines", "of core/job", "of core/kernel", "distance", "from"],
        rows,
        "Lines of code of each backend, and the distance to the nearest other one (the fraction of the lines of both that they do not "
        f"share). Mean over all pairs: {digits(1 - divergence['convergence'])}, a convergence of {digits(divergence['convergence'])}.",
        [1, 2, 3, 4],
    )


def _race(race: dict[str, Any]) -> Table:
    def cells(program: dict[str, Any]) -> list[str]:
        picture, wall, ratio, interval = (program[key] for key in ("picture", "wall", "times_ours", "times_ours_interval"))
        off = percent(picture["differing"] / (picture["width"] * picture["height"]), 3) if picture else "–"
        time = with_interval(wall["median"], wall["interval"], ms) if wall else "–"
        times = with_interval(ratio, interval) if ratio else "–"
        return [program["name"], program["verdict"], off, time, times, f"{program['memory'] / 2**20:.0f}", program["why"] or ""]

    return Table(
        ["program", "picture", "pixels that differ", "process ms", "times ours", "MiB", "reason"],
        [cells(program) for program in race["programs"]],
        f"Race: complete processes in alternation, {race['fractal']}, {race['width']} x {race['height']} pixels, "
        f"{race['rounds']} rounds, on {race['environment']['cpu']['model']}. A wrong picture has no time.",
        [2, 3, 4, 5],
    )


def section(material: Material) -> dict[str, Any]:
    def work(bench: Bench, row: Row) -> str:
        share = bench.work_over_scalar(row, material.backends.host)
        return "–" if share is None or abs(share - 1) < 0.01 else digits(share)

    entries = _portability(material)
    metric = [entry for entry in entries if not entry["not_measured"]]
    not_measured = {entry["application"]: entry["not_measured"] for entry in entries if entry["not_measured"]}
    tables = [
        _columns(material, lambda _, row: time_cell(row), "Kernel time and its 95 % interval [ms]; without brackets: too few samples for an interval."),
        _columns(material, lambda _, row: quotient_cell(row, "speed_up"), "Speed-up over the serial reference, wall times."),
        _columns(material, lambda _, row: quotient_cell(row, "over_scalar"), "Speed-up over the scalar kernel, wall times."),
        _columns(material, work, "Counted operations over the scalar kernel's, if they differ by more than 1 %; part of the speed-up is then due to the operations."),
        _simd_widths(material),
        _columns(material, lambda _, row: percent(row.figures["share_of_peak"]), "Counted operations per second as a share of the measured peak."),
        _columns(material, lambda _, row: row.verification["text"], "Results of verification."),
        _peaks(material),
        factor_table(material),
        *map(_race, material.results.races),
    ]
    divergence = material.results.code_divergence
    return {
        "tables": [table for table in tables if table],
        "reasons": _reasons(material),
        "missing": Missing("The timings", "make bench"),
        "portability": _portability_table(metric, not_measured),
        "cascade": portability.cascade(metric, material.backends),
        "lines_of_code": _lines_of_code(divergence) if divergence else None,
        "navigation": portability.navigation(metric, divergence, material.backends) if divergence else None,
        "loop_mix": material.results.loop_mix,
        "no_loop_mix": Missing("The instructions of the estimators' loops", "make loop-mix"),
    }
