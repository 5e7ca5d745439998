# SPDX-License-Identifier: Apache-2.0
"""Failures that have one clear line, and output files that appear whole."""

import os
from pathlib import Path


class InputError(Exception):
    """Bad input: a file that is broken, missing or of another version. Exit code 2."""


class Unavailable(Exception):
    """A tool that is not there. Exit code 77."""


def write_whole(path: Path, data: bytes) -> None:
    """Writes beside the target and renames, so that no reader ever sees half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(data)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
