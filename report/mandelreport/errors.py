# SPDX-License-Identifier: Apache-2.0
"""Failures described by one line, programs that are run, input in JSON, and output files that are written completely
or not at all. Needs only Python's standard library, as the scripts in tools/ use it too."""

import contextlib
import errno
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn


class InputError(Exception):
    """Bad input: a file that is broken, missing or of another version. Exit code 2."""


class Unavailable(Exception):
    """A missing tool. Exit code 77."""


def one_line(text: object) -> str:
    """Returns a text with ? for line ends, escape codes and all other characters that cannot be printed."""
    return "".join(c if c.isprintable() else "?" for c in str(text).strip())


def run_program(program: str, main: Callable[[], int]) -> NoReturn:
    """Ends the process with the exit code of main(), or with one line and the exit code of its failure."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # removes temporary files
    try:
        sys.exit(main())
    except (InputError, Unavailable, OSError) as error:
        print(f"{program}: {one_line(error)}", file=sys.stderr)
        sys.exit({InputError: 2, Unavailable: 77}.get(type(error), 1))


@contextlib.contextmanager
def reading(name: object, expected: str) -> Iterator[None]:
    """Turns an error of a block that only reads and checks the file `name` into an InputError with one line."""
    try:
        yield
    except OSError as error:
        raise InputError(f"{name}: {error.strerror or error}, expected {expected}") from error
    except RecursionError as error:
        raise InputError(f"{name}: nested too deep, expected {expected}") from error
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, EOFError) as error:
        why = f"{error} is missing" if isinstance(error, KeyError) else str(error)
        raise InputError(f"{name}: {why[:200]}, expected {expected}") from error


def read_json(path: Path, expected: str) -> Any:
    """Returns the content of a JSON file. Raises InputError with one line."""
    with reading(path, expected):
        return json.loads(path.read_bytes())


def output_of(*command: object, codes: tuple[int, ...] = (0,)) -> str:
    """Runs a program and returns its standard output. Raises InputError with the last line that the program prints if
    its exit code is not one of `codes`."""
    run = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if run.returncode not in codes:
        lines = (run.stdout + run.stderr).strip().splitlines() or ["failed without a message"]
        raise InputError(f"{command[0]}: {lines[-1]}")
    return run.stdout


def _replace(target: Path, data: bytes) -> None:
    """Writes a file with a private name next to `target` and renames it. If `target` is a mounted file, which cannot be
    replaced, writes to it."""
    mask = os.umask(0)
    os.umask(mask)
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~mask
    descriptor, part = tempfile.mkstemp(prefix=".mandelmarch-", dir=target.parent)
    try:
        with open(descriptor, "wb") as file:
            file.write(data)
            file.flush()
            with contextlib.suppress(OSError):  # some file systems have no permissions
                os.fchmod(descriptor, mode)
        os.replace(part, target)
    except OSError as error:
        if error.errno != errno.EBUSY:
            raise
        target.write_bytes(data)
    finally:
        Path(part).unlink(missing_ok=True)


def write_whole(path: Path, data: bytes) -> None:
    """Writes a file so that readers never see a part of it, as OutputFile of core/os does: links are followed, the
    permissions of a replaced file are kept, and devices, pipes and standard output (`-`) are written directly. Makes the
    folder."""
    try:
        if str(path) == "-":
            sys.stdout.buffer.write(data)
            sys.stdout.buffer.flush()
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists() and not path.is_file():
            with open(path, "ab") as stream:
                stream.write(data)
        else:
            _replace(Path(os.path.realpath(path)), data)
    except OSError as error:
        raise OSError(f"{path}: {error.strerror}") from error
