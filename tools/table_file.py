# SPDX-License-Identifier: Apache-2.0
"""Functions that print a tool's output, and write it to a file completely or not at all."""
import os
import sys


def put_file(text, path):
    """Writes text to a file. The file keeps its old content until the new content is complete."""
    try:
        with open(path + ".part", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".part", path)
    except OSError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {path}: {error.strerror}")


def put(text, path):
    """Prints text and, if a path is given, also writes it there."""
    if path:
        put_file(text, path)
    print(text, end="")
