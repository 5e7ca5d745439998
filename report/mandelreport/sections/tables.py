# SPDX-License-Identifier: Apache-2.0
"""Tables of the primary study and of performance portability. All results of the standard study are in a CSV file."""

import json
import re
from typing import Any

from .. import charts
from ..bench import Backends, Bench, Row
from ..blocks import Figure, Missing, Table, data_uri
from ..errors import output_of
from ..pictures import ROOT
from ..text import digits, ms, percent, with_interval
from . import Material
from .why import factor_table

STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"?|//[^\n]*|/\*.*?(?:\*/|\Z)', re.S)
SOURCES = {".h", ".cpp", ".cl", ".comp", ".cu", ".in"}


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


def timings(material: Material, bench: Bench) -> Table:
    """Returns a table with a line for each timed row of the primary study."""
    host, backends = material.backends.host, material.backends

    def work(row: Row) -> str:
        share = row.work_over_scalar(host)
        return "–" if share is None else digits(share)

    def place(row: Row) -> list[int]:
        return [names.index(name) for name, names in zip((*row.kind, row.label), orders)]

    rows = [row for row in bench.all_rows if row.timed]
    orders = [*(list(dict.fromkeys(row.data[key] for row in rows)) for key in ("fractal", "precision", "mode")), backends.order((row.label for row in rows))]
    return Table(
        ["fractal", "precision", "mode", "backend", "kernel ms", "over serial", "over scalar", "operations / scalar's", "share of peak", "picture"],
        [
            [
                *row.kind,
                row.label,
                time_cell(row),
                quotient_cell(row, "speed_up"),
                quotient_cell(row, "over_scalar"),
                work(row),
                percent(row.figures["share_of_peak"]),
                row.verification["text"],
            ]
            for row in sorted(rows, key=place)
        ],
        f"All times of {bench.name}: {bench.size} pixels on {bench.machine}. In brackets: 95 % intervals. Over serial, over scalar: wall-time "
        "speed-ups over the serial reference and over the scalar kernel. Operations / scalar's: counted operations over the scalar kernel's; if "
        "this is below 1, part of the speed-up is due to fewer operations.",
        [4, 5, 6, 7, 8],
    )


def _reasons(material: Material) -> list[str]:
    """Returns the distinct reasons why rows were not timed."""
    rows = [row for bench in material.results.study("standard") for row in bench.rows if not row.timed]
    return list(dict.fromkeys(row.unavailable or row.failure or f"{row.name}: {row.verification['text']}" for row in rows))


def _peaks(material: Material) -> Table | None:
    """Returns a table of each platform's highest multiply-add rate."""
    best: dict[tuple[str, str], dict[str, Any]] = {}
    for peak in (peak for bench in material.results.study("standard") for peak in bench.data["peaks"]):
        key = (peak["platform"], peak["precision"])
        if key not in best or peak["operations_per_second"] > best[key]["operations_per_second"]:
            best[key] = peak
    rows = [[*key, peak["backend"], digits(peak["operations_per_second"] / 1e9)] for key, peak in best.items()]
    caption = "Measured multiply-add peaks: the highest rate that any backend reached on the platform."
    return Table(["platform", "precision", "backend", "GFLOP/s"], rows, caption, [3]) if rows else None


def _portability(material: Material) -> list[dict[str, Any]]:
    """Returns Pennycook's metric over all platforms: from a run of `bench portability` over the machines' results, or
    from the result of the only machine."""
    standard = material.results.machines()
    program = material.studio.render.with_name("bench")
    if len(standard) > 1 and program.exists():
        text = output_of(program, "portability", *(bench.path for bench in standard), "--json", "-")
        return json.loads(text)
    return standard[0].data["portability"] if standard else []


def _portability_table(entries: list[dict[str, Any]], missing: dict[str, list[str]]) -> Table | None:
    """Returns a table of Pennycook's metric for the backends that were measured on all platforms. `missing`: for each
    other backend, the platforms on which it was not measured."""
    platforms = dict.fromkeys(on["platform"] for entry in entries for on in entry["platforms"])
    rows = []
    for entry in entries:
        metric = (f"by_{kind}" for kind in ("application_efficiency", "share_of_peak"))
        rows.append(
            [
                entry["fractal"],
                entry["precision"],
                entry["mode"],
                entry["application"],
                str(len(entry["platforms"])),
                *("–" if entry[key] is None else with_interval(entry[key], entry[f"{key}_interval"]) for key in metric),
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


def code_lines(text: str) -> int:
    """Returns the number of lines of a C or C++ source that are neither blank nor comments."""
    code = STRING_OR_COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else "\n" * found[0].count("\n"), text)
    return sum(bool(line.strip()) for line in code.split("\n"))


def _lines_of_code(backends: Backends) -> Table:
    """Counts the lines of the source folder in which the report is made."""

    def count(folder: str) -> int:
        files = (path for path in (ROOT / folder).rglob("*") if path.suffix in SOURCES)
        return sum(code_lines(path.read_text(encoding="utf-8", errors="replace")) for path in files)

    folders = [*(f"backends/{name}" for name in backends.names), "core/models", "core/kernel"]
    rows = [[folder, str(lines)] for folder in folders if (lines := count(folder))]
    caption = "Lines of code of each backend's folder, of the common part of models that run the scalar kernel in a loop, and of the kernel source."
    return Table(["folder", "lines"], rows, caption, [1])


def _cascade(entries: list[dict[str, Any]], backends: Backends) -> Figure | None:
    """Shows a panel for each fractal and mode, with a line for each backend and precision. The line's value at n is the
    metric over the n platforms on which the efficiency is highest. Dashes show the efficiency on each platform."""
    if not entries:
        return None
    fractals = list(dict.fromkeys(e["fractal"] for e in entries))
    modes = list(dict.fromkeys(e["mode"] for e in entries))
    platforms = max(len(e["cascade"]) for e in entries)
    figure, axes = charts.panels(len(modes), len(fractals), 8, 2.5 * len(modes), sharex=True, sharey=True)
    said = []
    for i, mode in enumerate(modes):
        for j, fractal in enumerate(fractals):
            axis = axes[i][j]
            here = [e for e in entries if e["fractal"] == fractal and e["mode"] == mode]
            for entry in here:
                look = charts.line(backends.number_of(entry["application"]))
                x = [k + 1 + (0.04 if entry["precision"] == "float" else -0.04) for k in range(len(entry["cascade"]))]
                fill = "full" if entry["precision"] == "double" else "none"
                name = f"{entry['application']} {entry['precision']}"
                axis.plot(x, [step["portability"] for step in entry["cascade"]], fillstyle=fill, label=name, **look)
                axis.plot(
                    x, [step["efficiency"] for step in entry["cascade"]], marker="_", linestyle="", color=look["color"]
                )
                said.append(f"{fractal} {mode} {name}: {digits(entry['by_application_efficiency'])}")
            axis.set(title=f"{fractal}, {mode}", ylim=(0, 1.05), xlim=(0.5, platforms + 0.5))
            axis.set_xticks(range(1, platforms + 1))
            if j == 0:
                axis.set_ylabel("efficiency")
            if i == len(modes) - 1:
                axis.set_xlabel("platforms, best first")
    charts.legend(figure, axes[0][0])
    return charts.block(
        figure,
        "Cascade of Pennycook's metric by application efficiency. " + "; ".join(said) + ".",
        "Cascade: the metric over the first 1, 2, ... platforms in order of decreasing efficiency (marks and lines), and the "
        "efficiency on each platform (dashes). Filled marks: double; open marks: float.",
    )


def tables(material: Material) -> dict[str, Any]:
    entries = _portability(material)
    metric = [entry for entry in entries if not entry["not_measured"]]
    not_measured = {entry["application"]: entry["not_measured"] for entry in entries if entry["not_measured"]}
    primary = material.answers.primary
    tables = [
        timings(material, primary) if primary else None,
        _simd_widths(material),
        _peaks(material),
        factor_table(material),
    ]
    return {
        "tables": [table for table in tables if table],
        "csv": data_uri("text/csv", material.timings.encode()) if material.timings else None,
        "no_csv": Missing("All timings as CSV", "make build report"),
        "reasons": _reasons(material),
        "missing": Missing("The timings", "make bench"),
        "portability": _portability_table(metric, not_measured),
        "cascade": _cascade(metric, material.backends),
        "lines_of_code": _lines_of_code(material.backends),
    }
