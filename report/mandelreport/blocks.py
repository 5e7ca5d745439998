# SPDX-License-Identifier: Apache-2.0
"""What a section is made of: figures, tables, and notes where there is no data. The templates' macro `show` prints each."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field


def data_uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


@dataclass(frozen=True)
class Figure:
    """`source`: a data URI; `alt`: what the picture shows, for those who do not see it; `see`: what to see in it."""

    source: str
    alt: str
    caption: str
    wide: bool = True
    see: str = ""
    kind: str = "figure"


@dataclass(frozen=True)
class Table:
    """`numbers`: the columns that are set flush right."""

    headers: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str
    numbers: Sequence[int] = field(default_factory=list)
    kind: str = "table"


@dataclass(frozen=True)
class Missing:
    """A part that has no data yet, and the command that makes it."""

    what: str
    command: str
    kind: str = "missing"


Block = Figure | Table | Missing
