# SPDX-License-Identifier: Apache-2.0
"""Environments of all measurements, in three tables: a column for each standard study; a line for each set of compiler,
flags and driver; a line for each other file."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from . import Material
from .method import instructions


def _told(what: Any, words: Callable[[Any], str]) -> str:
    """Returns a measured value of the machine as text, or the reason why it is missing. `what` is None for results of
    older builds of bench, which did not measure it."""
    if what is None:
        return "not recorded"
    return f"missing: {what['missing']}" if "missing" in what else words(what)


def _gpu(gpu: dict[str, Any]) -> str:
    parts = [f"{gpu[key]:.0f} {unit}" for key, unit in (("joules", "J"), ("watts", "W"), ("sm_megahertz", "MHz")) if gpu[key] is not None]
    return f"{gpu['name']}: {', '.join(parts)}, throttled: {gpu['throttled']}"


def _telemetry(environment: dict[str, Any]) -> dict[str, str]:
    told = environment.get("telemetry", {})
    counted = ("cycles", "instructions", "cache_misses", "branch_misses")
    return {
        "energy": _told(told.get("energy"), lambda e: ", ".join(f"{d['name']} {d['joules']:.0f} J" for d in e["domains"]) + f" in {e['seconds']:.0f} s"),
        "counters": _told(told.get("counters"), lambda c: ", ".join(f"{k} {c[k]:.3g}" for k in counted if c[k] is not None)),
        "GPUs": _told(told.get("gpus"), lambda gpus: "; ".join(_gpu(gpu) for gpu in gpus) if isinstance(gpus, list) else "–"),
    }


def _facts(bench: Bench, host: str) -> dict[str, str]:
    e = bench.environment
    cpu, git, build, during = e["cpu"], e["git"], e["build"], e["during"]
    return {
        "file": bench.name,
        "pixels": bench.size,
        "runs, seed": f"{bench.data['runs']}, {bench.data['seed']}",
        "SIMD": instructions(bench, host) or "–",
        "date": e["date"][:16].replace("T", " "),
        "revision": git["revision"][:12] + (", with uncommitted changes" if git["dirty"] else ""),
        "build": f"{build['type']}, {build['compiler']}, {build['version']}",
        "flags": build["flags"],
        "processor": f"{cpu.get('platform', cpu['model'])}, {cpu['cores_usable']} of {cpu['cores']} threads",
        "clock, microcode": f"{cpu['megahertz']} MHz, {cpu['microcode']}",
        "governor": cpu["governor"] or "unknown",
        "memory": f"{e['memory']['total_bytes'] / 2**30:.1f} GiB",
        "system": f"{e['os']['name']}, {e['os']['kernel']}, {e['os']['architecture']}",
        "load during the run": f"{during['load_at_start']:.1f} to {during['load_at_end']:.1f}",
        "used by others": f"{100 * during['others_share']:.1f} %",
        "stolen by the hypervisor": f"{100 * during['stolen_share']:.2f} %",
        **_telemetry(e),
        "warnings": str(len(bench.data["warnings"])),
    }


def _environments(material: Material) -> Table | None:
    benches = material.results.study("standard")
    facts = [_facts(bench, material.backends.host) for bench in benches]
    if not facts:
        return None
    rows = []
    for key in facts[0]:
        values = [of[key] for of in facts]
        rows.append([key, *(["as A" if k and value == values[0] and len(value) > 12 else value for k, value in enumerate(values)])])
    return Table(["", *(material.letter(bench.name) for bench in benches)], rows, "Results of the standard study.")


def _backends(material: Material) -> Table | None:
    """Returns a line for each distinct set of backend, compiler, flags and driver, with the results that have it."""
    lines: dict[tuple[str, ...], list[str]] = {}
    for bench in material.results.study("standard"):
        for backend in bench.environment["backends"]:
            devices = "; ".join(f"{d['name']} ({d['driver']})" for d in backend["devices"]) or backend["unavailable"] or "none"
            key = (backend["name"], backend["compiler"], backend["flags_exact"], backend["flags_fast"], devices)
            lines.setdefault(key, []).append(material.letter(bench.name))
    rows = [[key[0], ", ".join(letters), *key[1:]] for key, letters in sorted(lines.items())]
    headers = ["backend", "results", "compiler", "flags, exact", "flags, fast", "devices and drivers"]
    return Table(headers, rows, "Compilers, floating-point flags and drivers.") if rows else None


def section(material: Material) -> dict[str, Any]:
    others = [
        [b.name, b.study, b.machine, str(b.data["runs"]), b.environment["git"]["revision"][:12], b.environment["date"][:10]]
        for b in material.results.benches
        if b.study != "standard"
    ]
    headers = ["file", "study", "machine", "runs", "revision", "date"]
    tables = [_environments(material), _backends(material), Table(headers, others, "Other result files.", [3]) if others else None]
    warnings = [(material.letter(b.name), b.data["warnings"]) for b in material.results.study("standard") if b.data["warnings"]]
    return {"tables": [table for table in tables if table], "warnings": warnings, "missing": Missing("The environment of the timings", "make bench")}
