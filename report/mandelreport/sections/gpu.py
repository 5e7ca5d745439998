# SPDX-License-Identifier: Apache-2.0
"""What a GPU would do: the prediction for the Tesla K40 beside what the host's backend took."""

from __future__ import annotations

from typing import Any

from ..blocks import Missing, Table
from ..text import ms
from . import Material

SIZE = (1920, 1080)  # pixels, of the prediction


def _host(material: Material, fractal: str, precision: str, mode: str) -> str:
    rows = [
        (bench, row)
        for bench in material.results.benches
        if bench.study in ("standard", "resolution")
        for row in bench.timed(fractal=fractal, precision=precision, mode=mode, backend=material.backends.host)
        if (row.setting["width"], row.setting["height"]) == SIZE
    ]
    if not rows:
        return "–"
    bench, row = max(rows, key=lambda one: (one[0].data["launches"], one[1].kernel.count))
    return f"{ms(row.kernel.median)}{' *' if bench.study != 'standard' else ''}"


def section(material: Material) -> dict[str, Any]:
    text = next((t for t in material.results.files.values() if isinstance(t, str) and t.startswith("K40 on paper")), None)
    rows = []
    for words in (line.split() for line in (text or "").splitlines()):
        if len(words) in (9, 11) and words[1] in ("float", "double"):  # 9: before lanes were refilled
            refilled = words[10] if len(words) == 11 else "–"
            rows.append([*words[:4], *words[5:9], refilled, _host(material, *words[:3])])
    headers = ["fractal", "number", "mode", "operations a pixel", "instructions an operation", "lanes active", "predicted ms", "of peak", "with lanes that refill, ms"]
    table = Table(
        [*headers, f"{material.backends.host}, measured ms"],
        rows,
        f"Kernel time predicted for a Tesla K40 at {SIZE[0]} x {SIZE[1]} (tools/k40_expected.py), and the host's, measured on two threads of a processor (* in the study of resolutions).",
        list(range(3, 10)),
    )
    return {
        "table": table if rows else Missing("The prediction", "make k40"),
        "measured": material.results.gpu_measured(),
    }
