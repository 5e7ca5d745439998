# SPDX-License-Identifier: Apache-2.0
"""python3 -m mandelreport.demo: makes one page from bin/demo's results: a still, a film, the viewer, pictures,
differences and times.

Needs no package but Jinja. Exit codes: 0 success, 1 a file cannot be written, 2 wrong arguments or bad input."""

import argparse
import hashlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import jinja2

from . import viewer
from .blocks import data_uri
from .errors import InputError, read_json, reading, run_program, write_whole

LARGEST = 20 * 2**20  # bytes of the page
REFERENCE = "reference"


@dataclass
class Picture:
    """A picture, stored once for all rows whose pictures have the same bytes. `rows`: these rows of the table."""

    name: str  # in the page
    source: str
    rows: list[dict[str, Any]] = field(default_factory=list)


def label(row: dict[str, Any]) -> str:
    return f"{row['backend']}{'-scalar' if row['simd_width'] == 1 else ''}, {row['precision']}, {row['mode']}"


def substitute(row: dict[str, Any], cpu: str) -> str:
    """Returns the device, in brackets, of a backend for GPUs that ran on the CPU; empty for other backends, whose device
    is the processor `cpu` itself."""
    return f" ({row['device']})" if row["device"] != cpu and not row["is_gpu"] else ""


def pictures_of(folder: Path, rows: list[dict[str, Any]]) -> list[Picture]:
    found: dict[str, Picture] = {}
    for row in rows:
        if row["picture"]:
            if "/" in row["picture"]:
                raise ValueError(f"the picture {row['picture']} is in another folder")
            data = (folder / row["picture"]).read_bytes()
            digest = hashlib.sha256(data).hexdigest()
            name = f"{row['fractal']}-{len(found)}"
            found.setdefault(digest, Picture(name, data_uri("image/png", data))).rows.append(row)
    return list(found.values())


def bars_of(rows: list[dict[str, Any]], cpu: str) -> list[dict[str, Any]]:
    """Returns the times of each precision and mode as percentages of the longest time of all. Leaves out the reference,
    whose times are too long for bars."""
    timed = [row for row in rows if row["drawn"] and row["fine"] and row["backend"] != REFERENCE]
    longest = max((row["wall_seconds"] for row in timed), default=1.0)
    kinds = dict.fromkeys((row["precision"], row["mode"]) for row in timed)
    return [
        {
            "title": f"{precision}, {mode}",
            "rows": [
                {
                    "row": row,
                    "name": label(row).split(",")[0] + substitute(row, cpu),
                    "substitute": bool(substitute(row, cpu)),
                    "per_cent": 100 * row["wall_seconds"] / longest,
                }
                for row in timed
                if (row["precision"], row["mode"]) == (precision, mode)
            ],
        }
        for precision, mode in kinds
    ]


def absent_of(rows: list[dict[str, Any]]) -> dict[str, list[str]]:
    """Returns the backends that rendered nothing, by reason."""
    absent: dict[str, dict[str, None]] = {}
    for row in rows:
        if not row["drawn"] and row["fine"]:
            absent.setdefault(row["said"], {})[row["backend"]] = None
    return {reason: list(backends) for reason, backends in absent.items()}


def answer_of(rows: list[dict[str, Any]]) -> dict[str, Any] | None:
    """Returns the rows of a fractal whose pictures in double and exact mode have the bits of the scalar kernel, and the
    fastest of them; None if there are none."""
    exact = [row for row in rows if (row["precision"], row["mode"]) == ("double", "exact") and row["simd_width"] != 1]
    same = [row for row in exact if row["said"].endswith("same bits")]
    return {"same": same, "fastest": min(same, key=lambda row: row["wall_seconds"])} if same else None


def fractals_of(folder: Path, table: dict[str, Any]) -> list[dict[str, Any]]:
    result = []
    for name in dict.fromkeys(row["fractal"] for row in table["rows"]):
        rows = [row for row in table["rows"] if row["fractal"] == name]
        pictures = pictures_of(folder, rows)
        exact = [row for row in rows if row["picture"] and (row["precision"], row["mode"]) == ("double", "exact")]
        same = [label(row) for row in exact if row["backend"] != REFERENCE]
        result.append(
            {
                "name": name,
                "pictures": pictures,
                "choices": [(picture.name, label(row)) for row in rows for picture in pictures if row in picture.rows],
                "compared": (same[0], same[-1]) if same else ("", ""),
                "exact": [(row, next(p for p in pictures if row in p.rows)) for row in exact],
                "expected": [row for row in rows if row["drawn"] and row["backend"] == REFERENCE],
                "bars": bars_of(rows, table["cpu"]),
                "failed": [row for row in rows if not row["fine"]],
            }
        )
    return result


def page(folder: Path, programs: Path) -> str:
    path = folder / "demo.json"
    table = read_json(path, expected := f"a table of schema 1 as bin/demo --folder {folder} writes it")
    with reading(path, expected):
        if table["schema"] != 1:
            raise ValueError(f"schema {table['schema']}")
        first = table["rows"][0]["fractal"]
        answer = answer_of([row for row in table["rows"] if row["fractal"] == first])
        values = {"table": table, "fractals": fractals_of(folder, table), "absent": absent_of(table["rows"]), "answer": answer}

    def optional(kind: str, name: str) -> str | None:
        return data_uri(kind, (folder / name).read_bytes()) if (folder / name).exists() else None

    values |= {"still": optional("image/jpeg", "still.jpg"), "film": optional("video/mp4", "film.mp4")}
    values |= {"s": viewer.material(programs / "render", folder / "shaders", "make demo"), **viewer.assets()}
    with reading(path, expected):
        try:
            return viewer.environment().get_template("demo.html.j2").render(values)
        except jinja2.UndefinedError as error:
            raise ValueError(error) from error


def main() -> int:
    parser = argparse.ArgumentParser(prog="mandelreport.demo", description=__doc__)
    parser.add_argument("--folder", type=Path, default=Path("build/demo"), help="output folder of bin/demo (%(default)s)")
    parser.add_argument("--programs", type=Path, default=Path("bin"), help="folder with render (%(default)s)")
    parser.add_argument("--output", type=Path, default=Path("demo/index.html"), help="the page (%(default)s)")
    arguments = parser.parse_args()
    if arguments.output.resolve().parent == arguments.folder.resolve() and arguments.output.suffix != ".html":
        raise InputError(f"{arguments.output}: in the folder with the results, expected the name of a page, *.html")
    html = page(arguments.folder, arguments.programs.absolute()).encode()
    if len(html) > LARGEST:
        raise InputError(f"the page has {len(html)} bytes, more than {LARGEST}; use a smaller --side of bin/demo")
    write_whole(arguments.output, html)
    return 0


if __name__ == "__main__":
    run_program("demo", main)
