# SPDX-License-Identifier: Apache-2.0
"""Finds all files below the results folder, each read once, and the kind of each JSON file by its content."""

import json
import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .bench import HOST_COMPILERS, Backends, Bench, Row
from .blocks import Table
from .errors import InputError, output_of, reading
from .flight import Audit, FlightMap, read_audit, read_film, read_map
from .text import Number

RESULTS = Path("results")  # from the source folder
FLIGHT_STUDY = "flight_seeds.txt"  # the table of make flight-study


# The kinds of files from which bench computes figures.
OF_BENCH = ("mandelmarch-bench", "mandelmarch-bench-random")
PROGRAMS = Path(__file__).parents[2] / "bin"


class Files:
    """`read`: the content of each file read so far, by the file's path relative to the folder. Files of bench hold facts
    alone; their content is what `bench json` of the folder `programs` prints, with all figures. If a file cannot be read
    or parsed, its method raises InputError with one line."""

    def __init__(self, folder: Path, programs: Path = PROGRAMS):
        self.folder = folder
        self.bench_program = programs / "bench"
        self.read: dict[str, Any] = {}

    def json(self, name: str) -> Any:
        """Returns the content of the file `name`.json."""
        file = f"{name}.json"
        if file not in self.read:
            with reading(file, "JSON"):
                content = json.loads((self.folder / file).read_bytes())
            if isinstance(content, dict) and content.get("schema") in OF_BENCH:
                content = json.loads(output_of(self.bench_program, "json", self.folder / file))
            self.read[file] = content
        return self.read[file]

    def bench(self, name: str) -> Bench:
        return Bench(f"{name}.json", self.folder / f"{name}.json", self.json(name))


@dataclass
class Results:
    """All result files, in lists by kind, each in the order of the file names. `files`: the content of all files, by
    name."""

    files: dict[str, Any] = field(default_factory=dict)
    benches: list[Bench] = field(default_factory=list)
    maps: list[FlightMap] = field(default_factory=list)
    audits: list[Audit] = field(default_factory=list)
    films: list[Table] = field(default_factory=list)
    contact_sheets: list[Path] = field(default_factory=list)
    random: list[dict[str, Any]] = field(default_factory=list)  # bench random --json
    flight_studies: list[str] = field(default_factory=list)

    def study(self, name: str) -> list[Bench]:
        return [bench for bench in self.benches if bench.study == name]

    def backends(self, others: Iterable[str] = ()) -> Backends:
        """Returns all backends of the results and `others`. The backends of the result that has the most come first, in
        the order of that result."""
        lists = sorted((bench.environment["backends"] for bench in self.benches), key=len, reverse=True)
        rows = [row.backend for bench in self.benches for row in bench.rows]
        return Backends.of([backend for registered in lists for backend in registered], [*rows, *others])

    def whole(self) -> list[Bench]:
        """Returns the standard studies that compare at least three backends that use the kernel. If no study has three,
        returns those with the most. A study may lack a backend that another has: some take too long for large
        pictures."""
        standard = self.study("standard")
        reference = self.backends().reference
        compared = {id(bench): len({*bench.values("backend")} - {reference}) for bench in standard}
        enough = min(3, max(compared.values(), default=0))
        return [bench for bench in standard if compared[id(bench)] >= enough]

    def machines(self) -> list[Bench]:
        """Returns one study of whole() per machine. All these studies have the picture size that most machines share,
        so that the same pictures are compared. Leaves out machines that have no study of that size."""
        by_size: dict[str, dict[str, Bench]] = {}
        for bench in self.whole():
            chosen = by_size.setdefault(bench.size, {})
            if bench.machine not in chosen or bench.rank() > chosen[bench.machine].rank():
                chosen[bench.machine] = bench
        return list(max(by_size.values(), key=len, default={}).values())

    def primary(self) -> Bench | None:
        """Returns the main study of the report: the study of whole() with the most timed backends and, of several such
        studies, the one with the most runs. Returns None if there is no such study."""
        return max(self.whole(), key=Bench.rank, default=None)

    def host_compilers(self) -> list[str]:
        """Returns the names, without version, of the C++ compilers that built backends for the host in the standard
        studies."""
        built = [b["compiler"] for bench in self.study("standard") for b in bench.environment["backends"]]
        return [name for name in HOST_COMPILERS if any(compiler.startswith(name) for compiler in built)]

    def gpu_measured(self) -> bool:
        return any(row.is_gpu for bench in self.benches for row in bench.rows if row.timed)

    def timed(self, studies: Iterable[str], **wanted: Any) -> list[Row]:
        """Returns the timed rows with the given field values in these studies."""
        return [row for bench in self.benches if bench.study in studies for row in bench.timed(**wanted)]

    def of_size(self, size: tuple[int, int], **wanted: str) -> Row | None:
        """Returns the row with this picture size and the given field values from the standard study or the study of
        resolutions that has the most runs."""
        rows = [row for row in self.timed(("standard", "resolution"), **wanted) if row.size == size]
        return max(rows, key=lambda row: (row.bench.data["runs"], row.kernel.count), default=None)

    def fastest_gpu(self, size: tuple[int, int], **wanted: str) -> Row | None:
        """Returns the fastest row of a GPU with this picture size and the given field values in the standard study."""
        rows = [row for row in self.timed(("standard",), is_gpu=True, **wanted) if row.size == size]
        return min(rows, key=lambda row: row.kernel.median, default=None)

    def number(self, file: str, pointer: str) -> Number:
        return Number.at(file, self.files[file], pointer)


def _add_json(results: Results, files: Files, stem: str) -> None:
    name, data = f"{stem}.json", files.json(stem)
    kind = data if isinstance(data, dict) else {}
    with reading(name, "a result of this version"):
        if kind.get("schema") == "mandelmarch-bench":
            results.benches.append(files.bench(stem))
        elif kind.get("schema") == "mandelmarch-bench-random":
            results.random.append(data)
        elif kind.get("format") == "mandelmarch flight map 1":
            results.maps.append(read_map(name, data))
        elif kind.get("schema") == "mandelmarch-film":
            results.films.append(read_film(name, data))
        elif "promises_kept" in kind:
            results.audits.append(read_audit(data))
        else:
            print(f"report: {name}: not a result of bench or flythrough, left out", file=sys.stderr)


def read_results(folder: Path, programs: Path = PROGRAMS) -> Results:
    """Reads every result below `folder`. `programs`: the folder with bench. Raises InputError for a broken file or another
    version."""
    if not folder.is_dir():
        raise InputError(f"{folder}: not a folder, expected one with results of make bench")
    files = Files(folder, programs)
    results = Results(files.read)
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        kind = path.suffix
        if kind == ".json":
            _add_json(results, files, name.removesuffix(".json"))
        elif path.name == FLIGHT_STUDY:
            results.flight_studies.append(path.read_text(encoding="utf-8"))
        elif path.name.startswith("contact") and kind == ".jpg":
            results.contact_sheets.append(path)
    return results
