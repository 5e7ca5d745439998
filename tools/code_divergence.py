#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""code_divergence.py [FOLDER] [--json FILE] [--csv FILE]: counts the lines of code that each backend of a source tree
needs, and how few of them the backends share.

Code divergence is the mean, over all pairs of platforms, of the distance 1 - |a n b| / |a u b| of the sets of lines a
and b that they need (Harrell and Kitson, "Effective Performance Portability", P3HPC 2018). Code convergence is 1 -
divergence (Pennycook, Sewall and others, "Navigating Performance, Portability and Productivity", Computing in Science &
Engineering 23, 2021). Here each backend is a platform. It needs the lines of the files in its folder, and of those
files in core/kernel and core/job that its sources name, directly or indirectly. Blank lines and comments do not count;
lines that the preprocessor skips do. Backends that do not compile core/kernel (the reference) are left out.
Exit codes: 0 success, 1 a file cannot be written, 2 FOLDER is not a source tree of this program."""
import argparse
import csv
import io
import json
import os
import re
import sys

from table_file import put_file

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KERNEL, JOB, BACKENDS = "core/kernel/", "core/job/", "backends/"
SHARED_KERNEL = KERNEL + "text.h"
SOURCE = re.compile(r"[A-Za-z0-9_./-]+\.(?:h|cpp|cl|comp|cu|in)\b")
STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"?|//[^\n]*|/\*.*?(?:\*/|\Z)', re.S)


def stop(text):
    print(f"code_divergence: {text}", file=sys.stderr)
    sys.exit(2)


def lines_of_code(text):
    """Returns the numbers of the lines that contain code in a C or C++ source. The first line has the number 1."""
    code = STRING_OR_COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else "\n" * found[0].count("\n"), text)
    return [number for number, line in enumerate(code.split("\n"), 1) if line.strip()]


def count(coverage, folder=""):
    """Returns the number of lines of a coverage in the files of a folder."""
    return sum(len(lines) for name, lines in coverage.items() if name.startswith(folder))


def visit(root, name, own, coverage):
    """Adds a file, and the files that it names, to the coverage of the backend in the folder `own`."""
    path = os.path.join(root, name)
    if name in coverage or not name.startswith((own, KERNEL, JOB)) or not os.path.isfile(path):
        return
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    # The names of sources in CMakeLists.txt are followed, but its own lines do not count.
    if not name.endswith("CMakeLists.txt"):
        coverage[name] = lines_of_code(text)
    for other in SOURCE.findall(text):
        visit(root, other, own, coverage)
        visit(root, os.path.normpath(os.path.join(os.path.dirname(name), other)), own, coverage)
    if "MM_FRACTAL_FILE" in text:
        for fractal in os.listdir(os.path.join(root, KERNEL, "fractals")):
            visit(root, f"{KERNEL}fractals/{fractal}", own, coverage)


def coverage_of(root, backend):
    """Returns the lines that a backend needs: for each file, by name, the numbers of its lines of code."""
    own, coverage = f"{BACKENDS}{backend}/", {}
    for name in os.listdir(os.path.join(root, own)):
        visit(root, own + name, own, coverage)
    # A backend that uses core/job needs all of it, except a template for which the backend has its own.
    for name in os.listdir(os.path.join(root, JOB)) if count(coverage, JOB) else []:
        if not (name.endswith(".in") and os.path.exists(os.path.join(root, own, name))):
            visit(root, JOB + name, own, coverage)
    return coverage


def coverages_of(root):
    """Returns the coverage of each backend that compiles core/kernel, in the order of backends/CMakeLists.txt."""
    if not os.path.isfile(os.path.join(root, SHARED_KERNEL)):
        stop(f"{root}: expected the folder of the program's sources")
    try:
        with open(os.path.join(root, BACKENDS, "CMakeLists.txt"), encoding="utf-8") as file:
            listed = re.search(r"set\(backends\s([^)]*)\)", file.read())
        if listed is None:
            stop(f"{file.name}: expected a list of backends")
        found = {backend: coverage_of(root, backend) for backend in re.findall(r"\w+", listed[1])}
    except OSError as error:
        stop(f"{error.filename}: {error.strerror}")
    return {backend: coverage for backend, coverage in found.items() if SHARED_KERNEL in coverage}


def distance(one, other):
    """Returns the lines that are in only one of two coverages, as a fraction of the lines in either; 0 if there are no
    lines."""
    shared = sum(len(lines) for name, lines in one.items() if name in other)
    together = count(one) + count(other) - shared
    return 1 - shared / together if together else 0.0


def convergence(coverages):
    """Returns 1 - the mean distance over all pairs of coverages; 1 if there are fewer than two coverages."""
    distances = [distance(one, other) for i, one in enumerate(coverages) for other in coverages[:i]]
    return 1 - sum(distances) / len(distances) if distances else 1.0


def result_of(coverages):
    """Returns the content of the JSON file."""
    copied = [{f"{backend}:{name}" if name.startswith(KERNEL) else name: lines for name, lines in coverage.items()}
              for backend, coverage in coverages.items()]
    models = [{"backend": backend, "lines": count(coverage, BACKENDS), "lines_of_job": count(coverage, JOB),
               "lines_of_kernel": count(coverage, KERNEL),
               "distances": {name: distance(coverage, other) for name, other in coverages.items()}}
              for backend, coverage in coverages.items()]
    return {"schema": "mandelmarch-code-divergence", "version": 2, "models": models,
            "convergence": convergence(list(coverages.values())),
            "convergence_without_shared_kernel": convergence(copied)}


def csv_of(coverages):
    """Returns a CSV with the columns that p3-analysis-library's divergence() reads. A coverage in it follows that
    library's coverage.schema."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["problem", "application", "platform", "coverage"])
    for backend, coverage in coverages.items():
        files = [{"file": name, "id": name, "used_lines": lines, "unused_lines": []}
                 for name, lines in sorted(coverage.items())]
        rows.writerow(["all", "mandelmarch", backend, json.dumps(files, separators=(",", ":"))])
    return text.getvalue()


def table_of(result):
    lines = ["Code divergence: lines of code that backends need, and how few of them they share",
             f"{'backend':<10} {'lines':>8} {'core/job':>8} {'core/kernel':>11}  code distance from the others"]
    for model in result["models"]:
        backend, own, job, kernel, distances = model.values()
        numbers = " ".join(f"{value:.2f}" for value in distances.values())
        lines.append(f"{backend:<10} {own:>8} {job:>8} {kernel:>11}  {numbers}")
    lines.append(f"code convergence: {result['convergence']:.3f}; with a kernel text for each it would be "
                 f"{result['convergence_without_shared_kernel']:.3f}\n")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=ROOT, help="source tree (default: this program's)")
    parser.add_argument("--json", metavar="FILE", help="write the result to this file (-: standard output)")
    parser.add_argument("--csv", metavar="FILE", help="write lines by backend for p3-analysis-library (-: standard output)")
    args = parser.parse_args()
    if args.json and args.json == args.csv:
        parser.error(f"--json and --csv: '{args.json}' given for both, expected two files")
    coverages = coverages_of(args.folder)
    result = result_of(coverages)
    printed = table_of(result)
    for path, text in ((args.json, json.dumps(result, indent=1) + "\n"), (args.csv, csv_of(coverages))):
        if path == "-":
            printed = text
        elif path:
            put_file(text, path)
    print(printed, end="")


if __name__ == "__main__":
    main()
