# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport.results_page: writes docs/results.md, and the figures of README.md between its two markers, from
the result files. Exit codes: 0 success, 2 bad input."""

import html
import os
import re
import textwrap
from collections.abc import Iterable
from pathlib import Path

import jinja2

from . import viewer
from .bench import Bench, Row
from .blocks import Table
from .errors import InputError, run_program, write_whole
from .pictures import Cache, Studio
from .results import RESULTS, Results, read_results
from .sections import Material, front, pictures, tables
from .text import ms, percent, with_interval

ROOT = Path(__file__).parents[2]
MARKED = re.compile("(?<=<!-- results -->\n).*?(?=<!-- end -->)", re.S)  # the figures of README.md
TAGS = [
    (r'<p class="traced abstract">.*?</p>', ""),
    (r'<span class="screen">.*?</span>', ""),
    (r"<h3>(.*?)</h3>", r"### \1"),
    (r"</?p( [^>]*)?>", "\n\n"),
    (r"</?code>", "`"),
    (r"</?strong>", "**"),
    (r"</?[a-z][^>]*>", ""),
    (r"^#.*$", r"\n\n\g<0>\n\n"),
]


def markdown(text: str) -> str:
    """Returns a filled template as Markdown, in lines of at most 120 columns unless they are tables. The text may have
    the tags of the report's front page."""
    for tag, instead in TAGS:
        text = re.sub(tag, instead, text, flags=re.M if tag[0] == "^" else re.S)
    blocks = re.split(r"\n\s*\n", html.unescape(text).strip())
    return "\n\n".join(block if block[0] in "|#" else "\n".join(map(_lines, re.split(r"\n(?=- )", block))) for block in blocks) + "\n"


def _lines(text: str) -> str:
    """Breaks a paragraph or a list's item into lines, but not within brackets."""
    whole = re.sub(r"\[[^]]*\]", lambda found: found[0].replace(" ", "\0"), " ".join(text.split()))
    hang = "  " if text.startswith("- ") else ""
    return textwrap.fill(whole, 120, subsequent_indent=hang, break_long_words=False, break_on_hyphens=False).replace("\0", " ")


def _cell(row: Row, what: str) -> str:
    """Formats a value of a row: a time, a share, a speed-up, or the ratio that answers the question `what`."""
    if what == "share_of_peak":
        return percent(row.figures[what])
    if what in ("kernel", "wall"):
        return with_interval(getattr(row, what).median, getattr(row, what).interval, ms)
    if what not in row.bench.data["questions"]:
        return tables.quotient_cell(row, what)
    found = row.compared(what)
    return with_interval(found.median, found.interval) if found else "–"


def _pivoted(cells: Iterable[tuple[str, str, str]], corner: str) -> Table:
    """Returns a table of cells, each given with the names of its line and its column. `corner`: the first header."""
    lines: dict[str, dict[str, str]] = {}
    for line, column, text in cells:
        if text != "–":
            lines.setdefault(line, {})[column] = text
    columns = list(dict.fromkeys(column for of in lines.values() for column in of))
    return Table([corner, *columns], [[line, *(of.get(column, "–") for column in columns)] for line, of in lines.items()], "")


class Page:
    """The values and functions for the templates. `name`, `names`: files without `.json`."""

    def __init__(self, results: Results):
        none = Path(os.devnull)
        self.results, self.material = results, Material(results, Studio(none, Cache(none)), none)
        self.benches = {bench.name: bench for bench in results.benches}
        self.front = front.section(self.material)
        self.random = pictures.random_errors(results.random)

    def bench(self, name: str) -> Bench:
        return self.benches[f"{name}.json"]

    def pivot(self, names: str, lines: str, columns: str, what: str, **wanted: str) -> Table:
        """Returns a table of the values `what` of timed rows. `lines`, `columns`: the fields of a row that name its
        line and its column."""

        def of(row: Row, fields: str) -> str:
            return ", ".join(getattr(row, field) for field in fields.split())

        benches = [self.bench(name) for name in names.split()]
        rows = (row for bench in benches for row in bench.all_rows if row.timed)
        chosen = (row for row in rows if all(row.data[key] == value for key, value in wanted.items()))
        cells = ((of(row, lines), of(row, columns), _cell(row, what)) for row in chosen)
        return _pivoted(cells, ", ".join(bench.name for bench in benches))

    def files(self) -> Table:
        """Returns a table of all results, with a line for each machine, revision, date and number of runs."""
        files: dict[tuple[str, ...], list[str]] = {}
        for bench in self.results.benches:
            key = (bench.machine, str(bench.data["runs"]), bench.environment["date"][:10], bench.revision)
            files.setdefault(key, []).append(bench.name)
        rows = [[*key, ", ".join(names)] for key, names in files.items()]
        return Table(["machine", "runs", "date", "revision", "files"], rows, "All results of bench.")


def pages(results: Results) -> dict[Path, str]:
    """Returns the text of each page with figures."""
    page, readme = Page(results), ROOT / "README.md"
    values = {"macros": "macros.md.j2", "s": page.front, "page": page, "ms": ms, "folder": f"../{RESULTS}"}
    try:
        figures, whole = (markdown(viewer.environment().get_template(f"{name}.md.j2").render(values)) for name in ("readme", "results"))
    except (jinja2.UndefinedError, KeyError) as error:
        raise InputError(f"a result that the pages need is missing: {error}") from None
    marked, places = MARKED.subn(lambda _: figures, readme.read_text(encoding="utf-8"))
    if places != 1:
        raise InputError(f"{readme}: {places} places for figures, expected one between <!-- results --> and <!-- end -->")
    return {readme: marked, ROOT / "docs" / "results.md": whole}


def main() -> int:
    for path, text in pages(read_results(ROOT / RESULTS)).items():
        write_whole(path, text.encode())
    return 0


if __name__ == "__main__":
    run_program("results_page", main)
