# SPDX-License-Identifier: Apache-2.0
"""Failures described by one line, programs that are run, and output files that are written completely or not at
all."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn


class InputError(Exception):
    """Bad input: a file that is broken, missing or of another version. Exit code 2."""


class Unavailable(Exception):
    """A missing tool. Exit code 77."""


def run_program(program: str, main: Callable[[], int]) -> NoReturn:
    """Ends the process with the exit code of main(), or with one line and the exit code of its failure."""
    try:
        sys.exit(main())
    except (InputError, Unavailable, OSError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        sys.exit({InputError: 2, Unavailable: 77}.get(type(error), 1))


def output_of(*command: object, codes: tuple[int, ...] = (0,)) -> str:
    """Runs a program and returns its standard output. Raises InputError with the last line that the program prints if
    its exit code is not one of `codes`."""
    run = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if run.returncode not in codes:
        lines = (run.stdout + run.stderr).strip().splitlines() or ["failed without a message"]
        raise InputError(f"{command[0]}: {lines[-1]}")
    return run.stdout


def write_whole(path: Path, data: bytes) -> None:
    """Writes a new file next to `path` and renames it to `path`, so that readers never see a partial file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(data)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
