# SPDX-License-Identifier: Apache-2.0
"""Expected and measured times of GPUs, in a table for each GPU."""

import re
from typing import Any

from ..answers import FILM_SIZE as SIZE
from ..blocks import Missing, Table
from ..text import digits
from . import Material
from .tables import time_cell

PAPER = re.compile(r"(\w+) on paper,")
NAMES = {"H100": ("H100", "H200")}  # GPUs with the same multiprocessors
HEADERS = ["fractal", "precision", "mode", "backend", "cycles per iteration", "cycles per step", "lanes active in steps", "in iterations", "all cycles used, ms", "longest ray, ms", "expected ms, from", "to"]


def _kind(words: list[str]) -> dict[str, str]:
    return dict(zip(("fractal", "precision", "mode", "backend"), words))


def _host(material: Material, words: list[str]) -> str:
    found = material.results.of_size(SIZE, **_kind([*words[:3], material.backends.host]))
    return f"{time_cell(found[1])}{' *' if found[0].study != 'standard' else ''}" if found else "–"


def _table(material: Material, gpu: str, text: str) -> Table | None:
    lines = [words for words in map(str.split, text.splitlines()) if len(words) == len(HEADERS) and words[1] in ("float", "double")]
    found = [material.results.fastest_gpu(SIZE, NAMES.get(gpu, (gpu,)), **_kind(words[:4])) for words in lines]
    rows = []
    for words, one in zip(lines, found, strict=True):
        cells = list(words)
        if any(found):
            row = one and one[1]
            cells += [time_cell(row), digits(1e3 * row.kernel.median / float(words[-2]))] if row else ["–", "–"]
        rows.append([*cells, _host(material, words)])
    headers = [*HEADERS, *(["measured ms", "measured / from"] if any(found) else []), f"{material.backends.host} on the host, ms"]
    return Table(
        headers,
        rows,
        f"{gpu}: expected kernel time of the march at {SIZE[0]} x {SIZE[1]} (tools/gpu_expected.py), and the host's time, measured on two threads of a processor (*: in the study of resolutions).",
        list(range(4, len(headers))),
        name=f"expected-{gpu}",
    ) if rows else None


def section(material: Material) -> dict[str, Any]:
    papers = [(found[1], text) for text in material.results.files.values() if isinstance(text, str) and (found := PAPER.match(text))]
    # The card used in the course comes first.
    tables = [table for gpu, text in sorted(papers, key=lambda paper: paper[0] != "K40") if (table := _table(material, gpu, text))]
    return {
        "tables": tables or [Missing("The prediction", "make k40")],
        "names": [table.name for table in tables],
        "measured": material.results.gpu_measured(),
    }
