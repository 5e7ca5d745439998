# SPDX-License-Identifier: Apache-2.0
"""Contents of a section: figures, tables, output of programs, and notes for missing data. The templates' macro `show`
prints them, and Numbers numbers them."""

import base64
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from markupsafe import Markup


def data_uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


@dataclass(frozen=True)
class Figure:
    """`source`: a data URI; `alt`: a description for readers who cannot see the figure; `see`: what to notice in it;
    `name`: the name for ref()."""

    source: str
    alt: str
    caption: str
    wide: bool = True
    see: str = ""
    name: str = ""
    kind: str = "figure"


@dataclass(frozen=True)
class Table:
    """`numbers`: the indices of the columns that are right-aligned; `name`: the name for ref()."""

    headers: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str
    numbers: Sequence[int] = field(default_factory=list)
    name: str = ""
    kind: str = "table"


@dataclass(frozen=True)
class Output:
    """The output of a program, line by line. `wide`: its lines need small letters on paper."""

    text: str
    wide: bool = True
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


def ref(name: str) -> Markup:
    """Returns a reference to the figure or table with this name, for Numbers.resolved()."""
    return Markup('<a data-to="{}"></a>').format(name)


class Numbers:
    """Numbers of figures and tables, in the order in which the templates print them."""

    def __init__(self) -> None:
        self.last: Counter[str] = Counter()  # by kind
        self.named: dict[str, tuple[str, int]] = {}

    def next(self, kind: str, name: str = "") -> int:
        """Returns the number of the next block of this kind, whose name is `name`."""
        self.last[kind] += 1
        if name:
            self.named[name] = (kind, self.last[kind])
        return self.last[kind]

    def resolved(self, page: str) -> str:
        """Returns the page with a link in place of each reference. A block without data has no number."""

        def link(found: re.Match[str]) -> str:
            if found[1] not in self.named:
                return "a figure or table without data"
            kind, number = self.named[found[1]]
            return f'<a class="name" href="#{kind}-{number}">{kind.capitalize()} {number}</a>'

        return re.sub(r'<a data-to="([\w-]+)"></a>', link, page)
