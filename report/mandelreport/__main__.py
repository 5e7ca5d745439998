# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport: makes report.html and timings.csv from result files, and report.pdf if a browser exists.

Exit codes: 0 success, 1 a failure (the page is written and names failed devices), 2 wrong arguments or bad input,
77 the page is written, but there is no browser for its PDF."""

import argparse
import sys
from pathlib import Path

from . import page
from .errors import InputError, run_program, write_whole
from .pictures import Cache, Studio
from .results import RESULTS, read_results
from .sections import Material

LARGEST = 15 * 10**6  # bytes of the page


def main() -> int:
    parser = argparse.ArgumentParser(prog="mandelreport", description=__doc__)
    parser.add_argument("--results", type=Path, default=RESULTS, help="folder of result files (%(default)s)")
    parser.add_argument("--programs", type=Path, default=Path("bin"), help="folder with render, imgdiff and bench (%(default)s)")
    parser.add_argument("--work", type=Path, default=Path("build/report"), help="folder for intermediate files (%(default)s)")
    parser.add_argument("--output", type=Path, default=Path("report/out"), help="folder of the report (%(default)s)")
    parser.add_argument("--no-pdf", action="store_true", help="make only the page")
    arguments = parser.parse_args()
    results = read_results(arguments.results, arguments.programs.absolute())
    studio = Studio(arguments.programs.absolute(), Cache((arguments.work / "pictures").absolute()))
    material = Material(results, studio, arguments.work.absolute())
    html = page.render(material).encode()
    if len(html) > LARGEST:
        raise InputError(f"the page has {len(html)} bytes, more than {LARGEST}; use smaller contact sheets or fewer files")
    target = arguments.output / "report.html"
    write_whole(target, html)
    if material.timings:
        write_whole(arguments.output / "timings.csv", material.timings.encode())
    print(f"report: {target}, {len(html) / 2**20:.1f} MiB", file=sys.stderr)
    if not arguments.no_pdf:
        from .browser import print_page  # pylint: disable=import-outside-toplevel

        write_whole(arguments.output / "report.pdf", print_page(target))
        print(f"report: {arguments.output / 'report.pdf'}", file=sys.stderr)
    for key, why in studio.failures.items():
        print(f"report: {key.fractal}, {key}: {why}", file=sys.stderr)
    return 1 if studio.failures else 0


if __name__ == "__main__":
    run_program("report", main)
