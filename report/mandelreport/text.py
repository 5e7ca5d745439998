# SPDX-License-Identifier: Apache-2.0
"""Formatting of numbers. The page shows the source of each number of a sentence to readers who point at the number.

A source is a place or a formula of places. A place is a file's name and a JSON pointer (RFC 6901), such as
bench.json#/rows/12/operations."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from .errors import InputError


def digits(value: float, count: int = 3) -> str:
    """Formats a number with `count` significant digits, and with an exponent only if it is tiny."""
    if value == 0:
        return "0"
    if abs(value) < 1e-6:
        return f"{value:.{count - 1}e}"
    rounded = float(f"{value:.{count}g}")
    whole = len(str(int(abs(rounded)))) if abs(rounded) >= 1 else 0
    if whole:
        return f"{rounded:,.{max(0, count - whole)}f}"
    return f"{rounded:.10f}".rstrip("0")


def with_interval(value: float, interval: Iterable[float] | None, form: Callable[[float], str] = digits, between: str = " – ") -> str:
    """Formats a value with its interval, such as "1.23 [1.20 – 1.26]", or only the value if there is no interval."""
    return form(value) + (f" [{between.join(map(form, interval))}]" if interval else "")


def plain(value: float) -> str:
    """Formats a setting or threshold with at most four significant digits and no trailing zeros."""
    return digits(value, 4).rstrip("0").rstrip(".") if "." in digits(value, 4) else digits(value, 4)


def ms(seconds: float) -> str:
    return digits(1e3 * seconds)


def percent(share: float | None, decimals: int = 1) -> str:
    return "–" if share is None else f"{100 * share:.{decimals}f} %"


def join(words: list[str]) -> str:
    """Joins words as in "a, b and c"."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


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
