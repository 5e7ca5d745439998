# SPDX-License-Identifier: Apache-2.0
"""Sections of the report. The function section() of each module takes the material and returns the values for the
section's template. The module front is the first page. The main part and the appendix follow, in the order of
page.py."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from ..answers import Answers
from ..backends import Backends
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

    def letter(self, name: str) -> str:
        """Returns the letter that stands in tables for a result of the standard study: A for the first."""
        return chr(ord("A") + [bench.name for bench in self.results.study("standard")].index(name))
