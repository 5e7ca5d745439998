# SPDX-License-Identifier: Apache-2.0
"""Sections of the report. The function section() of each module takes the material and returns the values for the
section's template. The module front is the first page. The main part and the appendix follow, in the order of
page.py."""

import functools
from dataclasses import dataclass
from pathlib import Path

from ..answers import Answers
from ..bench import Backends
from ..errors import output_of
from ..pictures import Studio
from ..results import Results


@dataclass(frozen=True)
class Material:
    """All data of a report. `work`: a folder for intermediate files."""

    results: Results
    studio: Studio
    work: Path

    @functools.cached_property
    def backends(self) -> Backends:
        return self.results.backends(self.studio.backends)

    @functools.cached_property
    def answers(self) -> Answers:
        return Answers(self.results, self.backends)

    @functools.cached_property
    def timings(self) -> str | None:
        """Returns the output of `bench csv` for all results of the standard study, with the result's file as first
        column, or None if bench is missing or there is no result."""
        program = self.studio.render.with_name("bench")
        lines: list[str] = []
        for bench in self.results.study("standard") if program.exists() else ():
            header, *rows = output_of(program, "csv", bench.path).splitlines()
            lines += ([] if lines else [f"file,{header}"]) + [f"{bench.name},{row}" for row in rows]
        return "".join(f"{line}\n" for line in lines) or None

    def letter(self, name: str) -> str:
        """Returns the letter that stands in tables for a result of the standard study: A for the first."""
        return chr(ord("A") + [bench.name for bench in self.results.study("standard")].index(name))
