# SPDX-License-Identifier: Apache-2.0
"""What a GPU would do, a table for each that is reckoned or measured: predicted, measured, and how far apart they are."""

from __future__ import annotations

import re
from typing import Any

from ..bench import Row
from ..blocks import Block, Missing, Table
from ..text import digits
from . import Material
from .tables import time_cell

SIZE = (1920, 1080)  # pixels, of the prediction
PAPER = re.compile(r"(\w+) on paper,")
HEADERS = ["fractal", "precision", "mode", "operations a pixel", "instructions an operation", "lanes active", "predicted ms", "of peak", "with lanes that refill, ms"]


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
    return f"{time_cell(row)}{' *' if bench.study != 'standard' else ''}"


def _measured(material: Material, gpu: str, kind: tuple[str, ...]) -> list[Row]:
    """The rows of this GPU at the prediction's size, the fastest first."""
    rows = [
        row
        for bench in material.results.benches
        for row in bench.timed(fractal=kind[0], precision=kind[1], mode=kind[2])
        if row.is_gpu and gpu in row.device_name and (row.setting["width"], row.setting["height"]) == SIZE
    ]
    return sorted(rows, key=lambda row: row.kernel.median)


def _table(material: Material, gpu: str, text: str) -> Table | None:
    lines = [line.split() for line in text.splitlines()]
    kinds = [words for words in lines if len(words) in (9, 11) and words[1] in ("float", "double")]  # 9: before lanes were refilled
    measured = any(_measured(material, gpu, tuple(words[:3])) for words in kinds)
    rows = []
    for words in kinds:
        cells = [*words[:4], *words[5:9], words[10] if len(words) == 11 else "–"]
        if measured:
            best = next(iter(_measured(material, gpu, tuple(words[:3]))), None)
            over = digits(1e3 * best.kernel.median / float(words[7])) if best else "–"
            cells += [best.backend if best else "–", time_cell(best), over]
        rows.append([*cells, _host(material, *words[:3])])
    headers = [*HEADERS, *(["fastest backend", "measured ms", "measured / predicted"] if measured else []), f"{material.backends.host} on the host, ms"]
    return Table(
        headers,
        rows,
        f"{gpu}: kernel time predicted at {SIZE[0]} x {SIZE[1]} (tools/gpu_expected.py), and the host's, measured on two threads of a processor (* in the study of resolutions).",
        list(range(3, len(headers))),
    ) if rows else None


def section(material: Material) -> dict[str, Any]:
    papers = [(found[1], text) for text in material.results.files.values() if isinstance(text, str) and (found := PAPER.match(text))]
    # The course's card first.
    tables: list[Block] = [table for gpu, text in sorted(papers, key=lambda paper: paper[0] != "K40") if (table := _table(material, gpu, text))]
    return {"tables": tables or [Missing("The prediction", "make k40")], "measured": material.results.gpu_measured()}
