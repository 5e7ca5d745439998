# SPDX-License-Identifier: Apache-2.0
"""viewer_test.py RENDER: camera.js of the report's viewer computes the scene that RENDER --print-scene prints, for the views
of the folder scenes and for odd parameters. Negative controls: a value that is changed on one side only is detected.
Exits with 77 if node is missing."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "report"))

from mandelreport import viewer  # noqa: E402

CLOSE = 1e-6  # relative; the fields of the scene are rounded to float once
# Fields whose values in the viewer may differ from the programs'. The viewer needs no hull, because the picture is the
# same without it. The viewer's kernel is in float, which computes no normals from finite differences.
VIEWERS_OWN = ("hull", "subtile_hull", "spacing", "difference_step")
# Parameters that are tested in addition to the official scene's. Each list has the three numbers of line 7 of a
# parameter file and the last number of line 8.
ODD = {
    "mandelbulb": [[0, 4, 3, 0], [0, 4, 2.5, 0], [0, 6, 8.5, 0], [0, 1e6, 40, 0]],
    "mandelbox": [[-1.5, 0.5, 1, 100], [3.1, 0.7, 0.6, 30], [2, 0.25, 1.5, 1e6]],
    "julia": [[0.1, -0.5, 0.3, -0.2]],
}


def output(*command: object) -> str:
    return subprocess.run([*map(str, command)], check=True, capture_output=True, text=True).stdout


def parameters(scene: dict) -> str:
    lines = [scene[name] for name in ("eye", "target", "up")]
    lines += [[scene["field"]], scene["size"], [scene["detail"]], scene["shape"], [scene["iterations"], scene["escape"]]]
    lines += [[scene["colouring"]], [scene["brightness"]]]
    return "\n".join(" ".join(map(str, line)) for line in lines) + "\npicture.bmp\n"


def cases(table: dict) -> list[tuple[str, str, bool]]:
    """Returns fractal, parameter file, and whether the mode is fast."""
    views = viewer.views([row["name"] for row in table["fractals"]])
    found = [(view["fractal"], view["dat"], True) for view in views]
    for row in table["fractals"]:
        official = row["official"]
        for *shape, escape in [[*official["shape"], official["escape"]], *ODD.get(row["name"], [])]:
            text = parameters(official | {"shape": shape, "escape": escape, "size": [320, 180]})
            found += [(row["name"], text, fast) for fast in (False, True)]
    return found


def by_camera(table: dict, wanted: list[tuple[str, str, bool]]) -> list[dict]:
    """Returns the fields of the scenes as camera.js computes them."""
    script = (ROOT / "report" / "viewer" / "camera.js").read_text(encoding="utf-8") + f"""
        const table = {viewer.table_script(table)};
        const fields = (name, text, fast) => {{
            const scene = fromParameters(text);
            // The programs read parameter files in float.
            scene.shape = scene.shape.map(Math.fround);
            scene.escape = Math.fround(scene.escape);
            return {{ ...sceneFields(table, name, scene, new Camera(scene), ...scene.size, fast, table.rules.max_steps), miss: "Infinity" }};
        }};
        process.stdout.write(JSON.stringify({json.dumps(wanted)}.map((one) => fields(...one))));"""
    return json.loads(output("node", "-e", script))


def differing(mine: dict, printed: dict) -> list[str]:
    def same(a: object, b: object) -> bool:
        if isinstance(a, list):
            return len(a) == len(b) and all(map(same, a, b))
        return a == b or (isinstance(a, (int, float)) and abs(a - b) <= CLOSE * max(abs(b), 1e-3))

    return [name for name, value in mine.items() if name not in VIEWERS_OWN and not same(value, printed[name])]


def main() -> int:
    program = sys.argv[1]
    if shutil.which("node") is None:
        print("node is missing: tools/setup tests")
        return 77
    table = json.loads(output(program, "--list-fractals", "--json"))
    wanted, wrong = cases(table), []
    changed = json.loads(json.dumps(table))
    for row in changed["fractals"]:
        row |= {"constants": [f"(1.01 * {row['constants'][0]})", *row["constants"][1:]], "root_share": 1.5 * row["root_share"], "step_factor": "0.6"}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "scene.dat")
        for (fractal, text, fast), ours, other in zip(wanted, by_camera(table, wanted), by_camera(changed, wanted), strict=True):
            file.write_text(text, encoding="utf-8")
            printed = json.loads(output(program, "--fractal", fractal, file, "--precision", "float", "--mode", "fast" if fast else "exact", "--print-scene"))
            where = f"{fractal}, {'fast' if fast else 'exact'}, {text!r}"
            wrong += [f"{where}: {name}" for name in differing(ours, printed)]
            controls = {"fractal", "root_share", *(["step_factor"] if fast else [])}
            wrong += [f"{where}: another {name} is not detected" for name in controls - {*differing(other, printed)}]
            if "eye" not in differing(ours | {"eye": [1.01 * x for x in ours["eye"]]}, printed):
                wrong.append(f"{where}: a changed eye is not detected")
    print(*(f"WRONG {line}" for line in wrong), f"{len(wanted)} scenes compared; {len(wrong)} wrong", sep="\n")
    return 1 if wrong or not wanted else 0


if __name__ == "__main__":
    sys.exit(main())
