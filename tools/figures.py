#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""figures.py [--check] [--results FOLDER] FILE...: fills the marked places of documents from result files.

A place is `<!-- figures: NAME ARGUMENT... -->`, its content, `<!-- end -->`, within a line or around lines. The names
are functions of figure_tables.py and figure_numbers.py. --check writes nothing, and prints one line for each stale
place.
Exit codes: 0 success, 1 stale places, 2 an invalid place or result file."""
import argparse
import inspect
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "report"))
from figure_numbers import NUMBERS  # noqa: E402
from figure_tables import TABLES  # noqa: E402
from mandelreport.errors import InputError, run_program, write_whole  # noqa: E402
from mandelreport.files import Files  # noqa: E402

BEGIN = re.compile(r"<!-- figures: ([^\n]*?) -->")
END = "<!-- end -->"


def wanted(results, words):
    """Returns the content for a place with the name and arguments `words`: a table, with line breaks around it, or a
    number."""
    name, *arguments = words.split()
    figure = TABLES.get(name) or NUMBERS.get(name)
    if figure is None:
        raise InputError(f"no figure is called '{name}', expected one of {', '.join(sorted({*TABLES, *NUMBERS}))}")
    try:
        inspect.signature(figure).bind(results, *arguments)
    except TypeError as error:
        raise InputError(f"'{words}': {error}") from None
    return f"\n{figure(results, *arguments)}\n" if name in TABLES else figure(results, *arguments)


def places(name, text):
    """Yields (line, words, first, last) for each place. `line`: the number of its line; `words`: its name and
    arguments; `first`, `last`: the bounds of its content in the text."""
    at = 0
    while begin := BEGIN.search(text, at):
        line = text.count("\n", 0, begin.start()) + 1
        end = text.find(END, begin.end())
        following = BEGIN.search(text, begin.end())
        if end < 0 or (following and following.start() < end):
            raise InputError(f"{name}:{line}: '{begin[1]}' has no {END}")
        # If an HTML comment begins a line, Markdown takes the whole line for HTML.
        if text[: begin.start()].rpartition("\n")[2] == "" and begin[1].split()[0] not in TABLES:
            raise InputError(f"{name}:{line}: '{begin[1]}' begins a line, expected words before a number")
        yield line, begin[1], begin.end(), end
        at = end


def fill(name, text, results):
    """Returns the text with every place filled, and a line about each stale place."""
    parts, stale, at = [], [], 0
    for line, words, first, last in places(name, text):
        try:
            content = wanted(results, words)
        except InputError as error:
            raise InputError(f"{name}:{line}: {error}") from None
        if content != text[first:last]:
            stale.append(f"{name}:{line}: '{words}' is stale: {difference(text[first:last], content)}")
        parts += [text[at:first], content]
        at = last
    return "".join([*parts, text[at:]]), stale


def difference(old, new):
    """Returns a line that describes the first difference between two contents of a place."""
    lines = zip((old + "\n").split("\n"), (new + "\n").split("\n"))
    a, b = next(((a, b) for a, b in lines if a != b), ("", ""))
    return f"'{a.strip()}' stands there, the results say '{b.strip()}'"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results")
    parser.add_argument("file", type=pathlib.Path, nargs="+")
    args = parser.parse_args()
    results = Files(args.results)
    stale = []
    for path in args.file:
        try:
            text = path.read_text(encoding="utf-8")
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from None
        filled, found = fill(path, text, results)
        stale += found
        if filled != text and not args.check:
            write_whole(path, filled.encode())
    if not args.check:
        return 0
    for line in stale:
        print(f"{line}; `make docs-figures` fills it", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    run_program("figures", main)
