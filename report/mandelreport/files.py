# SPDX-License-Identifier: Apache-2.0
"""Result files of a folder, each read once."""

import json
from pathlib import Path
from typing import Any

from .bench import Bench
from .errors import InputError, output_of, reading


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

    def _bytes(self, name: str) -> bytes:
        try:
            return (self.folder / name).read_bytes()
        except OSError as error:
            raise InputError(f"{name}: {error.strerror}") from None

    def json(self, name: str) -> Any:
        """Returns the content of the file `name`.json."""
        file = f"{name}.json"
        if file not in self.read:
            data = self._bytes(file)
            with reading(file, "JSON"):
                content = json.loads(data)
            if isinstance(content, dict) and content.get("schema") in OF_BENCH:
                content = json.loads(output_of(self.bench_program, "json", self.folder / file))
            self.read[file] = content
        return self.read[file]

    def bench(self, name: str) -> Bench:
        return Bench(f"{name}.json", self.folder / f"{name}.json", self.json(name))
