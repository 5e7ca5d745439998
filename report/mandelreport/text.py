# SPDX-License-Identifier: Apache-2.0
"""Formatting of numbers."""

from collections.abc import Callable, Iterable

from .bench import Row


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


def where(row: Row) -> str:
    """Returns the name of a row's backend, followed by the device's index if that is not 0."""
    return row.backend if row.device == 0 else f"{row.backend} {row.device}"


def join(words: list[str]) -> str:
    """Joins words as in "a, b and c"."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
