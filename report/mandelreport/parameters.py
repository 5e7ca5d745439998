# SPDX-License-Identifier: Apache-2.0
"""Parameter files (.dat), as far as the viewer begins with them. The programs' own reader is the one that counts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .errors import InputError

ENTRIES = ["eye", "target", "up", "field", "size", "detail", "shape", "limits", "colouring", "brightness", "file"]


def read_parameters(path: Path) -> dict[str, Any]:
    """The entries by name: numbers, lists of numbers, and the picture file's name."""
    lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
    entries = [line for line in lines if line and not line.startswith("#")]
    if len(entries) != len(ENTRIES):
        raise InputError(f"{path}: {len(entries)} entries, expected {len(ENTRIES)}")
    found: dict[str, Any] = {}
    for name, text in zip(ENTRIES, entries):
        try:
            found[name] = text if name == "file" else [float(word) for word in text.split()]
        except ValueError:
            raise InputError(f"{path}: '{text}', expected numbers") from None
    for name in ("field", "detail", "colouring", "brightness"):
        found[name] = found[name][0]
    found["iterations"], found["escape"] = found.pop("limits")
    return found
