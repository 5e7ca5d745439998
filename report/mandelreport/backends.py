# SPDX-License-Identifier: Apache-2.0
"""The backends of the results, in the order of their registration."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Backends:
    """`names`: in the order of text and figures; the index is the backend's series number. The reference, which does
    not use the kernel, is last. `reference`, `host`: the backends with these roles; the defaults are for a report
    without results. `facts`: the descriptions of backends, as results have them, by name."""

    names: tuple[str, ...] = ()
    reference: str = "reference"
    host: str = "openmp"
    facts: dict[str, dict[str, Any]] = field(default_factory=dict)

    @staticmethod
    def of(registered: list[dict[str, Any]], others: Iterable[str] = ()) -> Backends:
        """`registered`: environment/backends of results; `others`: additional names."""
        roles = {backend["role"]: backend["name"] for backend in registered if backend.get("role")}
        reference = roles.get("reference", Backends.reference)
        names = dict.fromkeys([*(backend["name"] for backend in registered), *others])
        text = [name for name in names if name != reference]
        facts = {backend["name"]: backend for backend in registered[::-1] if backend.get("title")}  # it was built
        return Backends((*text, reference), reference, roles.get("host", Backends.host), facts)

    def title(self, backend: str) -> str:
        """Returns the model's name for people, as its description in a result has it."""
        return self.facts.get(backend, {}).get("title", backend)

    def number_of(self, backend: str) -> int:
        """Returns a backend's series number, the same in every figure."""
        return self.names.index(backend) if backend in self.names else len(self.names)

    def order(self, labels: Iterable[str]) -> list[str]:
        """Returns each label once, in the order of the backends. A label starts with its backend; "-scalar" or a
        device's number may follow."""
        return sorted(dict.fromkeys(labels), key=lambda label: (self.number_of(label.split()[0].removesuffix("-scalar")), label))
