# SPDX-License-Identifier: Apache-2.0
"""viewer_test.py RENDER: the report's viewer computes the same values as the program RENDER, also for odd parameters.

The formulas printed by --list-fractals --json give the values printed by --print-scene. If node is installed, camera.js
is run, too, and must give the same values, also for the views of the folder scenes. Negative controls: a value that is
changed on one side only is detected."""

from __future__ import annotations

import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "report"))

from mandelreport import viewer  # noqa: E402

CAMERA = ROOT / "report" / "viewer" / "camera.js"
CLOSE = {"float": viewer.CLOSE, "double": 1e-14}  # allowed relative difference: one or two roundings
LARGEST = {"float": 1e37, "double": 1e300}
# Parameters that are tested in addition to the official scene's. Each list has the three numbers of line 7 of a
# parameter file and the last number of line 8.
ODD = {
    "mandelbulb": [[0, 4, 3, 0], [0, 4, 2.5, 0], [0, 6, 8.5, 0], [0, 1e6, 40, 0]],
    "mandelbox": [[-1.5, 0.5, 1, 100], [3.1, 0.7, 0.6, 30], [2, 0.25, 1.5, 1e6]],
    "julia": [[0.1, -0.5, 0.3, -0.2]],
}
FUNCTIONS = {
    "min": min,
    "max": max,
    "pow": pow,
    "sqrt": math.sqrt,
    "abs": abs,
    "floor": math.floor,
    "sign": lambda a: math.copysign(1, a),
    "pick": lambda on, a, b: a if on else b,
}


def render(program: str, *arguments: object) -> str:
    return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def parameters(scene: dict) -> str:
    lines = [scene[name] for name in ("eye", "target", "up")]
    lines += [[scene["field"]], scene["size"], [scene["detail"]], scene["shape"], [scene["iterations"], scene["escape"]]]
    lines += [[scene["colouring"]], [scene["brightness"]]]
    return "\n".join(" ".join(map(str, line)) for line in lines) + "\npicture.bmp\n"


def computed(rules: dict, row: dict, scene: dict, precision: str, fast: bool) -> dict:
    """Returns the fields of a scene, computed from the formulas of --list-fractals."""
    inputs = {name: scene[name] for name in ("shape", "escape", "iterations")} | {"largest": LARGEST[precision], "conservative": 0}
    value = lambda text: float(eval(text, {"__builtins__": {}}, FUNCTIONS | inputs))  # pylint: disable=eval-used
    plain = rules["plain_step_factor"]
    step_factor = min(plain, value(row["step_factor"])) if fast else plain
    return {
        "fractal": [value(text) for text in row["constants"]],
        "fractal_whole": value(row["whole"]),
        "step_factor": step_factor,
        "relaxation": rules["longest_relaxed"] if fast and step_factor >= plain else step_factor,
        "root_share": row["root_share"],
        "end": rules["end"],
        "max_steps": rules["max_steps"],
    }


def by_camera(table: dict, name: str, text: str, fast: bool) -> dict:
    """Returns the fields of a scene as camera.js computes them."""
    script = CAMERA.read_text(encoding="utf-8") + f"""
        const table = {viewer.table_script(table)}, scene = fromParameters({json.dumps(text)});
        const fields = sceneFields(table, {json.dumps(name)}, scene, new Camera(scene), ...scene.size, {json.dumps(fast)},
            table.rules.max_steps);
        process.stdout.write(JSON.stringify({{ ...fields, miss: "Infinity" }}));"""
    return json.loads(subprocess.run(["node", "-e", script], check=True, capture_output=True, text=True).stdout)


def wrong_views(program: str, table: dict, file: Path) -> list[str]:
    """Returns the fields of the viewer's views that camera.js computes otherwise than the program. Writes to `file`."""
    wrong: list[str] = []
    names = [row["name"] for row in table["fractals"]]
    views = viewer.views(names)
    for view in views:
        file.write_text(view["dat"], encoding="utf-8")
        printed = json.loads(
            render(program, "--fractal", view["fractal"], file, "--precision", "float", "--mode", "fast", "--print-scene")
        )
        ours = by_camera(table, view["fractal"], view["dat"], True)
        wrong += [f"view {view['name']}: {name}" for name in viewer.differing_fields(ours, printed)]
        changed = ours | {"eye": [1.01 * x for x in ours["eye"]]}
        if "eye" not in viewer.differing_fields(changed, printed):
            wrong.append(f"view {view['name']}: a changed eye is not detected")
    return wrong if views or "mandelbulb" not in names else ["no views"]


def main() -> int:
    program = sys.argv[1]
    table = json.loads(render(program, "--list-fractals", "--json"))
    node = shutil.which("node") is not None
    wrong: list[str] = []
    compared = 0
    with tempfile.TemporaryDirectory() as folder:
        if node:
            wrong += wrong_views(program, table, Path(folder) / "view.dat")
        for row in table["fractals"]:
            official = row["official"]
            odd = [[*official["shape"], official["escape"]], *ODD.get(row["name"], [])]
            for numbers in odd:
                # The numbers are rounded to float, because the programs read parameter files in float.
                *shape, escape = (struct.unpack("f", struct.pack("f", number))[0] for number in numbers)
                scene = official | {"shape": shape, "escape": escape, "size": [320, 180]}
                file = Path(folder) / "scene.dat"
                file.write_text(parameters(scene), encoding="utf-8")
                for mode in ("exact", "fast"):
                    fast = mode == "fast"
                    for precision, close in CLOSE.items():
                        printed = json.loads(
                            render(program, "--fractal", row["name"], file, "--precision", precision, "--mode", mode, "--print-scene")
                        )
                        where = f"{row['name']} {shape} {escape}, {precision}, {mode}"
                        got = viewer.differing_fields(computed(table["scene"], row, scene, precision, fast), printed, close)
                        wrong += [f"{where}: {name}" for name in got]
                        compared += 1
                        if precision == "float" and node:
                            ours = by_camera(table, row["name"], parameters(scene), fast)
                            wrong += [f"{where}: camera.js: {name}" for name in viewer.differing_fields(ours, printed, close)]
                    # Negative controls: if a constant, the step factor or the root share is changed, fields differ.
                    controls = [
                        ("fractal", row | {"constants": [f"(1.01 * {row['constants'][0]})", *row["constants"][1:]]}),
                        ("root_share", row | {"root_share": 1.5 * row["root_share"]}),
                    ]
                    if fast:
                        controls.append(("step_factor", row | {"step_factor": "0.6"}))
                    for name, control in controls:
                        if name not in viewer.differing_fields(computed(table["scene"], control, scene, "double", fast), printed, 1e-14):
                            wrong.append(f"{row['name']} {shape}, {mode}: another {name} is not detected")
    for line in wrong:
        print("WRONG", line)
    print(f"{compared} scenes compared, camera.js {'too' if node else 'not: node is not there'}; {len(wrong)} wrong")
    return 1 if wrong or compared == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
