# SPDX-License-Identifier: Apache-2.0
"""Failures described by one line, and output files that are written completely or not at all."""

import os
from pathlib import Path


class InputError(Exception):
    """Bad input: a file that is broken, missing or of another version. Exit code 2."""


class Unavailable(Exception):
    """A missing tool. Exit code 77."""


def write_whole(path: Path, data: bytes) -> None:
    """Writes next to the target and renames, so that readers never see a partial file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(data)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
