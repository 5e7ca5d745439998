# SPDX-License-Identifier: Apache-2.0
"""Numbers in the report's text, each with its place in a result file. The page keeps both, for readers and for a test.

A place is a path of steps separated by ":". `rows` is a key, `verification.level` a nested key, `0` an index of a list.
`mode=fast&backend!=reference` keeps the matching elements of a list ("*" matches any text, > and < compare), and `a/b`
is a quotient of two keys. In a text file `mandelbulb float:-2` is the last word but one of the line that begins with
these words; "*" matches any word."""

from __future__ import annotations

import fnmatch
import re
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup, escape

from . import holm
from .errors import InputError
from .text import digits

STYLES = {
    "digits": digits,
    "four": lambda value: digits(value, 4),
    "whole": lambda value: f"{value:,.0f}",
    "plain": lambda value: f"{value:.0f}",
}
RULES = {"min": min, "max": max, "count": len}
CONDITION = re.compile(r"([\w.]+)(!=|=|>|<)(.*)", re.S)


def _key(value: Any, keys: str) -> Any:
    for key in keys.split("."):
        if value is None:
            return None
        value = value[int(key)] if isinstance(value, list) else value.get(key)
    return value


def _holds(element: Any, condition: str) -> bool:
    match = CONDITION.fullmatch(condition)
    if match is None:
        raise ValueError(f"no condition: {condition}")
    value, wanted = _key(element, match[1]), match[3]
    if match[2] in "><":
        return value is not None and (value > float(wanted) if match[2] == ">" else value < float(wanted))
    text = "null" if value is None else str(value)
    return fnmatch.fnmatchcase(text, wanted) == (match[2] == "=")


def _step(values: list[Any], step: str) -> list[Any]:
    if CONDITION.match(step):
        return [e for value in values for e in value if all(_holds(e, part) for part in step.split("&"))]
    if "/" in step:
        above, below = step.split("/")
        return [_key(value, above) / _key(value, below) for value in values]
    return [_key(value, step) for value in values]


def found(data: Any, path: str) -> list[Any]:
    """Returns all values at a place of a file: JSON, or text."""
    if isinstance(data, str):
        words, _, index = path.rpartition(":")
        begin = words.split()
        lines = [line.split() for line in data.splitlines()]
        like = [line for line in lines if len(line) > len(begin) and all(map(fnmatch.fnmatchcase, line, begin))]
        return [float(line[int(index)].rstrip("%")) for line in like]
    values = [data]
    for step in path.split(":"):
        values = _step(values, step)
    return values


@dataclass(frozen=True)
class Place:
    """`files`: names, whose values are concatenated; `rule`: combines several values into one; "one" expects a single
    value, "holm" counts the ratios of one file that are above 1, at 5 % for all of them together."""

    files: tuple[str, ...]
    path: str
    rule: str = "one"

    def of(self, data: dict[str, Any]) -> float:
        values = [value for file in self.files for value in found(data[file], self.path)]
        if self.rule == "holm":
            return holm.greater(data[self.files[0]], values)
        if self.rule != "count" and (not values or None in values or (self.rule == "one" and len(values) != 1)):
            raise InputError(f"{', '.join(self.files)}: {self.path} has {len(values)} values, expected one")
        return values[0] if self.rule == "one" else RULES[self.rule](values)


@dataclass(frozen=True)
class Trace:
    """`data`: contents of the files, by name."""

    data: dict[str, Any]

    def number(self, place: Place, style: str = "digits", scale: float = 1, over: Place | None = None) -> Markup:
        """Formats `scale` times the value, divided by that of `over` if given."""
        value = scale * place.of(self.data) / (1 if over is None else over.of(self.data))
        attributes = {"value": repr(value), "title": f"{', '.join(place.files)}: {place.path}", "data-style": style}
        attributes["data-scale"] = repr(scale)
        for end, of in (("", place), ("-over", over)):
            if of is not None:
                attributes |= {f"data-file{end}": " ".join(of.files), f"data-path{end}": of.path, f"data-rule{end}": of.rule}
        written = "".join(f' {name}="{escape(text)}"' for name, text in attributes.items())
        return Markup(f"<data{written}>{STYLES[style](value)}</data>")

    def one(self, file: str, path: str, style: str = "digits", scale: float = 1) -> Markup:
        return self.number(Place((file,), path), style, scale)

    def with_interval(self, file: str, value: str, interval: str, scale: float = 1) -> Markup:
        """Formats a number with its interval in brackets, or a note if there are too few samples."""
        number = self.one(file, value, scale=scale)
        if found(self.data[file], interval)[0] is None:
            return number + Markup(" [too few samples for an interval]")
        low, high = (self.one(file, f"{interval}:{end}", scale=scale) for end in (0, 1))
        return number + Markup(" <span class=\"interval\">[") + low + ", " + high + Markup("]</span>")

    def times(self, file: str, path: str, scale: float = 1) -> Markup:
        """Formats a summary of bench: its median and interval."""
        return self.with_interval(file, f"{path}:median", f"{path}:interval", scale)
