# SPDX-License-Identifier: Apache-2.0
"""Contents of a section: figures, tables, output of programs, and notes for missing data. The templates' macro `show`
prints and numbers them."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field, replace


def data_uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


@dataclass(frozen=True)
class Figure:
    """`source`: a data URI; `alt`: a description for readers who cannot see the figure; `see`: what to notice in it."""

    source: str
    alt: str
    caption: str
    wide: bool = True
    see: str = ""
    kind: str = "figure"


@dataclass(frozen=True)
class Table:
    """`numbers`: the indices of the columns that are right-aligned."""

    headers: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str
    numbers: Sequence[int] = field(default_factory=list)
    kind: str = "table"


@dataclass(frozen=True)
class Output:
    """The output of a program, line by line."""

    text: str
    kind: str = "output"


@dataclass(frozen=True)
class Missing:
    """A part without data, and the command that produces the data."""

    what: str
    command: str
    kind: str = "missing"


Block = Figure | Table | Output | Missing


def seen(figure: Figure | None, see: str) -> Figure | None:
    """Returns the figure with `see`, the sentence that says what can be seen in it; None if there is no figure."""
    return figure and replace(figure, see=see)
