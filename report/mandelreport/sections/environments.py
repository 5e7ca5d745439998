# SPDX-License-Identifier: Apache-2.0
"""Method of the measurements, and their environments: a line for each result of the standard study, for each machine and
build, for each set of compiler, flags and driver, and for each other file."""

from collections.abc import Iterable, Sequence
from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from . import Material


def instructions(bench: Bench, host: str) -> str:
    rows = [row for row in bench.timed(backend=host) if row.instruction_set]
    return ", ".join(dict.fromkeys(row.instruction_set for row in rows))


def method(material: Material) -> dict[str, Any]:
    rows = []
    for bench in material.results.study("standard"):
        rows.append(
            [
                material.letter(bench.name),
                bench.name,
                bench.machine,
                bench.size.replace(" x ", "\N{NO-BREAK SPACE}x\N{NO-BREAK SPACE}"),
                str(bench.data["runs"]),
                instructions(bench, material.backends.host).replace("-", "\N{NON-BREAKING HYPHEN}"),
                bench.revision,
            ]
        )
    table = Table(
        ["", "file", "machine", "pixels", "runs", "SIMD", "revision"],
        rows,
        "Results of the standard study. Appendix E uses their letters.",
        [4],
    )
    return {"table": table if rows else Missing("The results", "make bench")}


def _gpus(environment: dict[str, Any]) -> str:
    """Returns the readings of the GPUs, or the reason why they are missing."""
    gpus = environment.get("telemetry", {}).get("gpus", {"missing": "not recorded"})
    return "; ".join(map(_gpu, gpus)) if isinstance(gpus, list) else f"missing: {gpus['missing']}"


def _gpu(gpu: dict[str, Any]) -> str:
    parts = [f"{gpu[key]:.0f} {unit}" for key, unit in (("watts", "W"), ("sm_megahertz", "MHz")) if gpu[key] is not None]
    return f"{gpu['name']}: {', '.join(parts)}, throttled: {gpu['throttled']}"


def _measurement(bench: Bench) -> list[str]:
    e = bench.environment
    during = e["during"]
    return [
        bench.name,
        e["date"][:16].replace("T", " "),
        bench.revision,
        f"{bench.data['runs']}, {bench.data['seed']}",
        f"{during['load_at_start']:.1f} to {during['load_at_end']:.1f}",
        f"{100 * during['others_share']:.1f} %",
        f"{100 * during['stolen_share']:.2f} %",
        str(len(bench.data["warnings"])),
    ]


def _machine(bench: Bench, host: str) -> list[str]:
    e = bench.environment
    cpu, build = e["cpu"], e["build"]
    return [
        f"{cpu['platform']}, {cpu['cores_usable']} of {cpu['cores']} threads",
        f"{cpu['megahertz']} MHz, {cpu['microcode']}",
        cpu["governor"] or "unknown",
        f"{e['memory']['total_bytes'] / 2**30:.1f} GiB",
        f"{e['os']['name']}, {e['os']['kernel']}, {e['os']['architecture']}",
        instructions(bench, host) or "–",
        f"{build['type']}, {build['compiler']}, {build['version']}, {build['flags']}",
    ]


def _grouped(entries: Iterable[tuple[str, Sequence[str]]]) -> list[list[str]]:
    """Returns a line for each distinct sequence of cells, after the letters of the results that have it."""
    lines: dict[tuple[str, ...], list[str]] = {}
    for letter, cells in entries:
        lines.setdefault(tuple(cells), []).append(letter)
    return [[", ".join(letters), *cells] for cells, letters in lines.items()]


def _tables(material: Material) -> list[Table]:
    benches = [(material.letter(bench.name), bench) for bench in material.results.study("standard")]
    if not benches:
        return []
    backends = sorted(
        (
            (letter, [b["name"], b["compiler"], b["flags_exact"], b["flags_fast"],
                      "; ".join(f"{d['name']} ({d['driver']})" for d in b["devices"]) or b["unavailable"] or "none"])
            for letter, bench in benches
            for b in bench.environment["backends"]
        ),
        key=lambda entry: (entry[1][0], entry[0]),
    )
    return [
        Table(
            ["", "file", "date", "revision", "runs, seed", "load", "used by others", "stolen by the hypervisor", "warnings"],
            [[letter, *_measurement(bench)] for letter, bench in benches],
            "Results of the standard study.",
            [8],
        ),
        Table(
            ["results", "processor", "clock, microcode", "governor", "memory", "system", "SIMD", "build"],
            _grouped((letter, _machine(bench, material.backends.host)) for letter, bench in benches),
            "Machines and builds.",
        ),
        Table(
            ["results", "GPUs"],
            _grouped((letter, [_gpus(bench.environment)]) for letter, bench in benches),
            "Power and clocks of GPUs after the first run.",
        ),
        Table(
            ["results", "backend", "compiler", "flags, exact", "flags, fast", "devices and drivers"],
            _grouped(backends),
            "Compilers, floating-point flags and drivers.",
        ),
    ]


def discussion(material: Material) -> dict[str, Any]:
    results = material.results
    machines = list(dict.fromkeys(bench.machine for bench in results.benches))
    return {"machines": machines, "compilers": results.host_compilers(), "gpu_measured": results.gpu_measured()}


def environments(material: Material) -> dict[str, Any]:
    others = [
        [b.name, b.study, b.machine, str(b.data["runs"]), b.revision, b.environment["date"][:10]]
        for b in material.results.benches
        if b.study != "standard"
    ]
    headers = ["file", "study", "machine", "runs", "revision", "date"]
    tables = _tables(material) + ([Table(headers, others, "Other result files.", [3])] if others else [])
    warnings = [(material.letter(b.name), b.data["warnings"]) for b in material.results.study("standard") if b.data["warnings"]]
    return {"blocks": tables or [Missing("The environment of the timings", "make bench")], "warnings": warnings}
