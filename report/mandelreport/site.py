# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport.site: makes a folder for any web server: front page, gallery of views, films, viewer.

Exit codes: 0 success, 1 a failure, 2 wrong arguments or bad input."""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

from markupsafe import Markup

from . import page, viewer
from .errors import InputError, write_whole
from .pictures import SCENES, Cache, Studio
from .results import read_results
from .sections import Material

SIZE = "640x360"  # of the gallery's pictures


def run(*command: object) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise InputError(f"{command[0]}: {done.stderr.strip()}")
    return done.stdout


def gallery(folder: Path, programs: Path, output: Path, names: list[str]) -> list[dict[str, str]]:
    """Renders the official scenes and each NAME.FRACTAL.dat of the folder. Views that the viewer cannot show get no
    link to it."""
    files = [(f"official-{fractal}", fractal, file) for fractal, file in SCENES.items()]
    for file in sorted(folder.glob("*.*.dat")):
        name, fractal, _ = file.name.split(".")
        files.append((name, fractal, file))
    if len(files) == len(SCENES):
        raise InputError(f"{folder}: no views, expected files NAME.FRACTAL.dat")
    views = []
    for name, fractal, file in files:
        picture = output / "views" / f"{name}.png"
        picture.parent.mkdir(parents=True, exist_ok=True)
        run(programs / "render", file, "--fractal", fractal, "--backend", "openmp", "--size", SIZE, "--output", picture)
        text = file.read_text(encoding="utf-8")
        write_whole(picture.with_suffix(".dat"), text.encode())
        views.append(
            {
                "name": name.replace("-", " "),
                "fractal": fractal,
                "picture": f"views/{name}.png",
                "file": f"views/{name}.dat",
                "live": f"viewer.html#{urlencode({'fractal': fractal, 'dat': text})}" if fractal in names else "",
            }
        )
    return views


def films(folder: Path, output: Path) -> list[dict[str, str]]:
    """Returns the existing films FRACTAL-SEED.mp4."""
    found = []
    for file in sorted(folder.glob("*-*.mp4")) if folder.is_dir() else []:
        fractal, seed = file.stem.rsplit("-", 1)
        (output / "films").mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, output / "films" / file.name)
        found.append({"fractal": fractal, "seed": seed, "file": f"films/{file.name}"})
    return found


def write(name: str, output: Path, **values: Any) -> None:
    text = page.environment().get_template(name + ".j2").render(style=viewer.raw("templates/style.css"), **values)
    write_whole(output / name.removeprefix("site_"), text.encode())


def main() -> int:
    parser = argparse.ArgumentParser(prog="mandelreport.site", description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("report/results"), help="folder of result files (%(default)s)")
    parser.add_argument("--programs", type=Path, default=Path("bin"), help="folder with render (%(default)s)")
    parser.add_argument("--views", type=Path, default=Path("report/views"), help="folder of views, NAME.FRACTAL.dat (%(default)s)")
    parser.add_argument("--films", type=Path, default=Path("build/films"), help="folder of films, FRACTAL-SEED.mp4 (%(default)s)")
    parser.add_argument("--work", type=Path, default=Path("build/report"), help="folder for intermediate files (%(default)s)")
    parser.add_argument("--output", type=Path, default=Path("build/site"), help="folder of the site (%(default)s)")
    arguments = parser.parse_args()
    try:
        programs = arguments.programs.absolute()
        table = json.loads(run(programs / "render", "--list-fractals", "--json"))
        live = viewer.material(table, arguments.work.absolute())
        studio = Studio(programs, Cache((arguments.work / "pictures").absolute()))
        front = page.front_page(Material(read_results(arguments.results), studio, arguments.work.absolute()))
        views = gallery(arguments.views, programs, arguments.output, live["fractals"])
        write("site_viewer.html", arguments.output, s=live, viewer=viewer.scripts())
        write("site_index.html", arguments.output, front=Markup(front), views=views, films=films(arguments.films, arguments.output))
        print(f"site: {arguments.output / 'index.html'}", file=sys.stderr)
    except InputError as error:
        print(f"site: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"site: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
