# SPDX-License-Identifier: Apache-2.0
"""Sections: each module's function takes the material and returns what its template prints."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from ..backends import Backends
from ..pictures import Studio
from ..results import Results


@dataclass(frozen=True)
class Material:
    """Everything that a report is made of. `work`: a folder for files in between."""

    results: Results
    studio: Studio
    work: Path

    @functools.cached_property
    def backends(self) -> Backends:
        return self.results.backends(self.studio.backends)
