# SPDX-License-Identifier: Apache-2.0
"""Pennycook's metric, for backends that were selected on every platform of H: not measured does not mean
unsupported."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .bench import Bench


def platforms(entries: list[dict[str, Any]]) -> list[str]:
    """Returns H: every platform that some entry names."""
    return list(dict.fromkeys(on["platform"] for entry in entries for on in entry["platforms"]))


def _asked(platform: str, benches: Iterable[Bench]) -> set[str]:
    """Returns the backends with a row in a result of this platform, timed or not."""
    asked = set()
    for bench in benches:
        own = {row["platform"] for row in bench.data["rows"] if row["figures"] is not None}
        if any(name and platform.startswith(name) for name in own):  # machines of the same name are numbered
            asked |= {row["backend"] for row in bench.data["rows"]}
    return asked


def measured(entries: list[dict[str, Any]], benches: Iterable[Bench]) -> tuple[list[dict[str, Any]], dict[str, list[str]]]:
    """Returns the entries of backends that were selected on all platforms; for each other one, the platforms without
    it."""
    benches = list(benches)
    asked = {platform: _asked(platform, benches) for platform in platforms(entries)}
    missing: dict[str, list[str]] = {}
    for entry in entries:
        ran = {on["platform"] for on in entry["platforms"] if on["kernel_seconds"] is not None}
        without = [p for p in asked if p not in ran and entry["application"] not in asked[p]]
        if without:
            missing.setdefault(entry["application"], without)
    return [entry for entry in entries if entry["application"] not in missing], missing
