# SPDX-License-Identifier: Apache-2.0
"""How the tools here hand over a text: in a file that is whole or not there, and printed."""
import os
import sys


def put_file(text, path):
    """Writes text to a file, which keeps what it has until the new one is whole."""
    try:
        with open(path + ".part", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".part", path)
    except OSError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {path}: {error.strerror}")


def put(text, path):
    """Prints text and, if a path is given, writes it there too."""
    if path:
        put_file(text, path)
    print(text, end="")
