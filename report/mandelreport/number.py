# SPDX-License-Identifier: Apache-2.0
"""Numbers of the report's sentences. The page shows each number's source to readers who point at the number.

A source is a place or a formula of places. A place is a file's name and a JSON pointer (RFC 6901), such as
bench.json#/rows/12/operations."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from .bench import Bench, Row
from .errors import InputError
from .text import digits

STYLES = {
    "digits": digits,
    "four": lambda value: digits(value, 4),
    "whole": lambda value: f"{value:,.0f}",
    "plain": lambda value: f"{value:.0f}",
}
LONGEST = 200  # characters of a source that the page shows


def found(data: Any, pointer: str) -> Any:
    """Returns the value at `pointer` in `data`, a file's content."""
    for key in pointer.split("/")[1:]:
        data = data[int(key) if isinstance(data, list) else key]
    return data


@dataclass(frozen=True)
class Number:
    value: float
    source: str

    @staticmethod
    def at(file: str, data: Any, pointer: str) -> Number:
        """Returns the number at `pointer` in `data`, the content of `file`."""
        value = found(data, pointer)
        if not isinstance(value, (int, float)):
            raise InputError(f"{file}: {pointer} is {value}, expected a number")
        return Number(value, f"{file}#{pointer}")

    @staticmethod
    def of_row(bench: Bench, row: Row, pointer: str) -> Number:
        """Returns a number at a pointer within a row of a result."""
        return Number.at(bench.name, bench.data, bench.at(row, pointer))

    @staticmethod
    def count(places: list[str]) -> Number:
        return Number(len(places), f"count({', '.join(places)})")

    def __truediv__(self, other: Number) -> Number:
        divisor = f"({other.source})" if " " in other.source else other.source
        return Number(self.value / other.value, f"{self.source} / {divisor}")

    def __rmul__(self, factor: float) -> Number:
        return self if factor == 1 else Number(factor * self.value, f"{factor!r} * {self.source}")

    def html(self, style: str = "digits") -> Markup:
        shown = textwrap.shorten(self.source, LONGEST, placeholder=" ...")
        return Markup('<data value="{!r}" title="{}">{}</data>').format(self.value, shown, STYLES[style](self.value))
