# SPDX-License-Identifier: Apache-2.0
"""The backends of the results, in the order of their registration."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Backends:
    """Text and figures show backends in the order of `names`, and their place in it is their series in every figure. The
    reference, which is not the text, is the last. Old results state no roles: the names are those of their time."""

    names: tuple[str, ...] = ()
    reference: str = "reference"
    host: str = "openmp"

    @staticmethod
    def of(registered: list[dict[str, Any]], others: Iterable[str] = ()) -> Backends:
        """`registered`: environment/backends of results; `others`: names that may be in none of them."""
        roles = {backend["role"]: backend["name"] for backend in registered if backend.get("role")}
        reference = roles.get("reference", Backends.reference)
        names = dict.fromkeys([*(backend["name"] for backend in registered), *others])
        text = [name for name in names if name != reference]
        return Backends((*text, reference), reference, roles.get("host", Backends.host))

    def number_of(self, backend: str) -> int:
        """The series number of a backend, the same in every figure."""
        return self.names.index(backend) if backend in self.names else len(self.names)

    def order(self, labels: Iterable[str]) -> list[str]:
        """Each label once; the first word of a label is its backend, a device's number or a comma may follow."""
        return sorted(dict.fromkeys(labels), key=lambda label: (self.number_of(label.split()[0].rstrip(",")), label))
