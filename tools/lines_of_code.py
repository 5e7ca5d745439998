#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""lines_of_code.py [FOLDER]: prints, as JSON, the number of lines of code that each backend of a source tree needs: those
of the files in its folder, and of those files in core/kernel and core/models that its sources name, directly or
indirectly. Blank lines and comments do not count; lines that the preprocessor skips do. Backends that do not compile
core/kernel (the reference) are left out."""
import json
import os
import re
import sys

KERNEL, JOB = "core/kernel/", "core/models/"
SOURCE = re.compile(r"[A-Za-z0-9_./-]+\.(?:h|cpp|cl|comp|cu|in)\b")
STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"?|//[^\n]*|/\*.*?(?:\*/|\Z)', re.S)


def lines_of_code(text):
    """Returns the number of lines that contain code in a C or C++ source."""
    code = STRING_OR_COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else "\n" * found[0].count("\n"), text)
    return sum(bool(line.strip()) for line in code.split("\n"))


def visit(name, own, lines):
    """Adds the lines of a file, and of the files that it names, to those of the backend in the folder `own`."""
    if name in lines or not name.startswith((own, KERNEL, JOB)) or not os.path.isfile(name):
        return
    with open(name, encoding="utf-8", errors="replace") as file:
        text = file.read()
    # The names of sources in CMakeLists.txt are followed, but its own lines do not count.
    lines[name] = 0 if name.endswith("CMakeLists.txt") else lines_of_code(text)
    for other in SOURCE.findall(text):
        visit(other, own, lines)
        visit(os.path.normpath(os.path.join(os.path.dirname(name), other)), own, lines)
    if "MM_FRACTAL_FILE" in text:
        for fractal in os.listdir(KERNEL + "fractals"):
            visit(f"{KERNEL}fractals/{fractal}", own, lines)


def needed(backend):
    """Returns the numbers of lines that a backend needs, or None if it does not compile core/kernel."""
    own, lines = f"backends/{backend}/", {}
    for name in os.listdir(own):
        visit(own + name, own, lines)
    # A backend that uses core/models needs all of it, except a template for which the backend has its own.
    for name in os.listdir(JOB) if any(name.startswith(JOB) for name in lines) else []:
        if not (name.endswith(".in") and os.path.exists(own + name)):
            visit(JOB + name, own, lines)
    counts = {key: sum(count for name, count in lines.items() if name.startswith(folder))
              for key, folder in (("lines", own), ("lines_of_job", JOB), ("lines_of_kernel", KERNEL))}
    return {"backend": backend, **counts} if KERNEL + "text.h" in lines else None


def main():
    os.chdir(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    with open("backends/CMakeLists.txt", encoding="utf-8") as file:
        listed = re.search(r"set\(backends\s([^)]*)\)", file.read())
    models = filter(None, map(needed, re.findall(r"\w+", listed[1])))
    print('{"schema": "mandelmarch-lines-of-code", "models": [\n ' + ",\n ".join(map(json.dumps, models)) + "\n]}")


try:
    main()
except OSError as error:
    sys.exit(f"lines_of_code: {error.filename}: {error.strerror}, expected the folder of the program's sources")
