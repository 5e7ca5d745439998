"""How the tools here hand over a table: printed, and in a file that is whole or not there."""
import os
import sys


def put(text, path):
    """Prints text and, if a path is given, writes it there too."""
    if path:
        try:
            with open(path + ".part", "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(path + ".part", path)
        except OSError as error:
            sys.exit(f"{os.path.basename(sys.argv[0])}: {path}: {error.strerror}")
    print(text, end="")
