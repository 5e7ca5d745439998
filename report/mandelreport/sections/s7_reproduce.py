# SPDX-License-Identifier: Apache-2.0
"""Section 7: how to reproduce everything."""

from __future__ import annotations

from typing import Any

from ..bench import Bench
from ..blocks import Missing, Table
from . import Material


def _environment(bench: Bench) -> Table:
    e = bench.environment
    cpu, git, build = e["cpu"], e["git"], e["build"]
    during = e["during"]
    rows = [
        [
            "study",
            f"{bench.study}, {bench.data['launches']} launch{'es' if bench.data['launches'] != 1 else ''}, seed "
            f"{bench.data['seed']}, {e['date']}",
        ],
        ["revision", git["revision"] + (", with changes that are not committed" if git["dirty"] else "")],
        ["build", f"{build['type']}, {build['compiler']}, {build['flags']}, version {build['version']}"],
        [
            "processor",
            f"{cpu.get('platform', cpu['model'])} ({cpu['vendor']}), {cpu['cores_usable']} of {cpu['cores']} threads, "
            f"{cpu['megahertz']} MHz, microcode {cpu['microcode']}, governor {cpu['governor'] or 'unknown'}",
        ],
        ["memory", f"{e['memory']['total_bytes'] / 2**30:.1f} GiB"],
        ["system", f"{e['os']['name']}, {e['os']['kernel']}, {e['os']['architecture']}"],
        [
            "meanwhile",
            f"load {during['load_at_start']:.1f} to {during['load_at_end']:.1f}, others' share of the processors "
            f"{100 * during['others_share']:.1f} %, stolen by a hypervisor {100 * during['stolen_share']:.2f} %",
        ],
    ]
    return Table(["", ""], rows, f"The environment of {bench.name}.")


def _backends(bench: Bench) -> Table:
    rows = []
    for backend in bench.environment["backends"]:
        devices = "; ".join(f"{d['name']} ({d['driver']})" for d in backend["devices"]) or backend["unavailable"] or "none"
        rows.append([backend["name"], backend["compiler"], backend["flags_exact"], backend["flags_fast"], devices])
    return Table(
        ["backend", "compiler", "flags, exact", "flags, fast", "devices and drivers"],
        rows,
        f"Compilers, floating-point flags and drivers of {bench.name}.",
    )


def section(material: Material) -> dict[str, Any]:
    standard = material.results.study("standard")
    others = sorted(
        {
            (b.name, b.study, b.environment["git"]["revision"], b.environment["date"])
            for b in material.results.benches
            if b.study != "standard"
        }
    )
    return {
        "environments": [(_environment(bench), _backends(bench)) for bench in standard],
        "missing": Missing("The environment of the timings", "make bench"),
        "others": Table(["file", "study", "revision", "date"], [list(entry) for entry in others], "The other result files.")
        if others
        else None,
    }
