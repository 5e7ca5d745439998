# SPDX-License-Identifier: Apache-2.0
"""A result file of bench: names and units for the part of `bench json` that the report uses; and the backends of all
results, in the order of their registration."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from markupsafe import Markup

from .text import Number, found

HOST_COMPILERS = ("GNU", "Clang")
SCALAR = "simd-width=1"  # sweep value of the scalar kernel's rows
SAME_WORK = 0.01  # relative; in fast mode, work depends a little on the order in which pixels are rendered


@dataclass(frozen=True)
class Times:
    """The median of seconds or of ratios of times, and its 95 % interval, which is None for fewer than six samples."""

    median: float
    interval: list[float] | None
    count: int = 0

    @staticmethod
    def of(summary: dict[str, Any]) -> Times:
        return Times(summary["median"], summary["interval"], summary["count"])

    def inverse(self) -> Times:
        """Returns the inverse of a ratio."""
        return Times(1 / self.median, self.interval and [1 / end for end in self.interval[::-1]], self.count)

    def scaled(self, factor: float) -> Times:
        return Times(factor * self.median, self.interval and [factor * end for end in self.interval], self.count)

    def errors(self) -> tuple[float, float]:
        """Returns the lengths of an error bar downwards and upwards; both are 0 if there is no interval."""
        low, high = self.interval or (self.median, self.median)
        return (max(0.0, self.median - low), max(0.0, high - self.median))


@dataclass(frozen=True, eq=False)
class Row:
    """One configuration of a study. `bench`: its file; `data`: its row in the file; `at`: the row's JSON pointer."""

    bench: Bench
    data: dict[str, Any]
    at: str

    def __getattr__(self, name: str) -> Any:
        if name == "data":  # not set yet while a copy is being made
            raise AttributeError(name)
        try:
            return self.data[name]
        except KeyError:
            raise AttributeError(name) from None

    def number(self, pointer: str) -> Number:
        return self.bench.number(self.at + pointer)

    @property
    def timed(self) -> bool:
        return self.data["figures"] is not None

    @property
    def kernel(self) -> Times:
        return Times.of(self.data["figures"]["kernel_seconds"])

    @property
    def wall(self) -> Times:
        return Times.of(self.data["figures"]["wall_seconds"])

    @property
    def value(self) -> str:
        """Returns the sweep value without its name: "2" for threads=2."""
        return self.data["sweep_value"].partition("=")[2]

    @property
    def kind(self) -> tuple[str, str, str]:
        return self.data["fractal"], self.data["precision"], self.data["mode"]

    @property
    def size(self) -> tuple[int, int]:
        """Returns width and height in pixels."""
        return self.data["setting"]["width"], self.data["setting"]["height"]

    @property
    def visibly_off(self) -> float:
        """Returns the fraction of pixels that differ visibly from the expected picture."""
        return self.data["verification"]["visibly_differing"] / self.data["verification"]["pixels"]

    @property
    def where(self) -> str:
        """Returns the backend, followed by the device's index if that is not 0."""
        return self.data["backend"] if self.data["device"] == 0 else f"{self.data['backend']} {self.data['device']}"

    @property
    def label(self) -> str:
        """Returns the name of a standard study's row in tables and charts."""
        # Its backend runs on one thread of the host and leaves the other cores idle.
        one_thread = " (1 thread)" if self.threads == 1 and not self.is_gpu else ""
        return f"{self.where}{self.application.removeprefix(self.backend)}{one_thread}"

    def scalar(self, host: str) -> Row | None:
        """Returns the scalar kernel's timed row with the same fractal, precision and mode, or None."""
        rows = (r for r in self.bench.all_rows if r.backend == host and r.sweep_value == SCALAR)
        return next((r for r in rows if r.timed and r.kind == self.kind), None)

    def work_over_scalar(self, host: str) -> float | None:
        """Returns the counted operations divided by the scalar kernel's; None if either is not counted."""
        scalar = self.scalar(host)
        return self.operations / scalar.operations if scalar is not None and scalar.operations and self.operations else None

    def compared(self, question: str) -> Times | None:
        """Returns the ratio whose numerator is this row, or None if the question has no such ratio."""
        ratio = self.bench.ratio(question, self.name)
        return ratio.times if ratio else None


@dataclass(frozen=True)
class Ratio:
    """A ratio of kernel times of two rows, given by their names, that were timed in the same rounds."""

    bench: Bench
    at: str
    numerator: str
    denominator: str
    times: Times

    def html(self) -> Markup:
        return self.bench.times(self.at)


@dataclass(frozen=True, eq=False)
class Bench:
    """A result file. `name`: its path, relative to the folder of results, for display."""

    name: str
    path: Path
    data: dict[str, Any]

    @property
    def study(self) -> str:
        return self.data["study"]

    @functools.cached_property
    def all_rows(self) -> list[Row]:
        return [Row(self, row, f"/rows/{at}") for at, row in enumerate(self.data["rows"])]

    @functools.cached_property
    def rows(self) -> list[Row]:
        """Returns all rows but those of the standard study's scalar kernel. The other rows have their speed-up over it
        as over_scalar."""
        return [row for row in self.all_rows if row.application == row.backend]

    def timed(self, **wanted: Any) -> list[Row]:
        """Returns the timed rows with the given field values."""
        return [row for row in self.rows if row.timed and all(row.data[k] == v for k, v in wanted.items())]

    @property
    def environment(self) -> dict[str, Any]:
        return self.data["environment"]

    @property
    def revision(self) -> str:
        git = self.environment["git"]
        return git["revision"][:7] + (" and changes" if git["dirty"] and git["revision"] != "unknown" else "")

    @functools.cached_property
    def in_cpp(self) -> list[str]:
        """Returns the backends whose kernels a C++ compiler of the host compiled."""
        return [b["name"] for b in self.environment["backends"] if b["compiler"].startswith(HOST_COMPILERS)]

    @property
    def machine(self) -> str:
        """Returns the processor, the number of usable cores, and the GPUs of the rows."""
        cpu = self.environment["cpu"]
        gpus = sorted({row.device_name for row in self.rows if row.is_gpu})
        return ", ".join([f"{cpu['platform']}, {cpu['cores_usable']} threads", *gpus])

    @property
    def size(self) -> str:
        """Returns the size of the timed pictures."""
        return ", ".join(dict.fromkeys("{} x {}".format(*row.size) for row in self.rows if row.timed))

    def rank(self) -> tuple[int, int]:
        """Returns the number of timed backends and the number of runs."""
        return len(self.values("backend")), self.data["runs"]

    def number(self, pointer: str) -> Number:
        return Number.at(self.name, self.data, pointer)

    def with_interval(self, value: str, interval: str, scale: float = 1) -> Markup:
        """Formats a number with its interval in brackets or, if there are too few samples for one, with a note."""
        number = (scale * self.number(value)).html()
        if found(self.data, interval) is None:
            return number + Markup(" [too few samples for an interval]")
        low, high = ((scale * self.number(f"{interval}/{end}")).html() for end in (0, 1))
        return number + Markup(' <span class="interval">[') + low + ", " + high + Markup("]</span>")

    def times(self, summary: str, scale: float = 1) -> Markup:
        """Formats a summary of bench: its median and interval."""
        return self.with_interval(f"{summary}/median", f"{summary}/interval", scale)

    def ratios(self, question: str) -> list[Ratio]:
        """Returns the ratios that answer a question."""
        return [
            Ratio(self, f"/questions/{question}/{at}/ratio", entry["numerator"], entry["denominator"], Times.of(entry["ratio"]))
            for at, entry in enumerate(self.data["questions"][question])
            if entry["ratio"]["count"]
        ]

    def ratio(self, question: str, numerator: str) -> Ratio | None:
        """Returns the ratio whose numerator is the row of this name, or None if the question has no such ratio."""
        return next((ratio for ratio in self.ratios(question) if ratio.numerator == numerator), None)

    def named(self, name: str) -> Row:
        return next(row for row in self.all_rows if row.name == name)

    def fastest(self) -> list[Row]:
        """Returns a standard study's fastest row of each fractal, precision and mode."""
        return [self.named(ranking["fastest"]) for ranking in self.data["winners"]]

    def wins(self, backend: str) -> bool:
        return all(row.backend == backend for row in self.fastest())

    def values(self, key: str) -> list[str]:
        """Returns the distinct values of a field among the timed rows, in the file's order."""
        return list(dict.fromkeys(row.data[key] for row in self.rows if row.timed))


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


def count(rows: list[Row]) -> Markup:
    """Formats the number of rows."""
    return Number.count([f"{row.bench.name}#{row.at}" for row in rows]).html("whole")
