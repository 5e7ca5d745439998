#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""path_csv.py export PATH.json FILE.csv
path_csv.py import PATH.json FILE.csv NEW.json

export writes a path file's cameras as a table, one line a frame: frame, x, y, z of location, look_at and up, field_of_view, and,
where a frame has one, the three numbers of its shape (line 7 of a parameter file). import makes NEW.json of PATH.json with
the table's cameras and shapes; what else its frames have stays. Frames may be fewer or more: what PATH.json has no frame for
takes the last one's. Exit code 2: a file that cannot be read, or is none."""
import csv
import json
import math
import os
import sys
import tempfile

VECTORS = ("location", "look_at", "up")
COLUMNS = ["frame"] + [f"{name}_{axis}" for name in VECTORS for axis in "xyz"] + ["field_of_view"]
SHAPE = ["shape_1", "shape_2", "shape_3"]


def stop(text):
    print(f"path_csv: {text}", file=sys.stderr)
    sys.exit(2)


def read_path(name):
    try:
        with open(name, encoding="utf-8") as file:
            path = json.load(file)
    except (OSError, ValueError) as error:
        stop(f"{name}: {error}")
    if not isinstance(path, dict) or path.get("format") != "mandelmarch path 1" or not path.get("frames"):
        stop(f"{name}: no path file with frames")
    return path


def line_of(path):
    """The text of a path file, a line a frame, as flythrough writes it."""
    head = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in path.items() if key != "frames"]
    frames = ",\n".join(json.dumps(frame) for frame in path["frames"])
    return "{\n" + ",\n".join(head) + ',\n"frames": [\n' + frames + "\n]\n}\n"


def put(name, text):
    """The file is complete or not there."""
    try:
        with tempfile.NamedTemporaryFile("w", encoding="utf-8", newline="", dir=os.path.dirname(os.path.abspath(name)),
                                         delete=False) as file:
            file.write(text)
        os.chmod(file.name, 0o644)
        os.replace(file.name, name)
    except OSError as error:
        stop(f"{name}: {error.strerror}")


def table_of(path):
    changes = any("shape" in frame for frame in path["frames"])
    lines = [",".join(COLUMNS + SHAPE * changes)]
    for number, frame in enumerate(path["frames"]):
        numbers = [value for name in VECTORS for value in frame[name]] + [frame["field_of_view"]]
        if changes:
            numbers += frame.get("shape", path["scene"]["shape"])
        lines.append(",".join([str(number)] + [repr(value) for value in numbers]))
    return "\n".join(lines) + "\n"


def with_table(path, name):
    try:
        with open(name, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError) as error:
        stop(f"{name}: {error}")
    if not rows or rows[0] not in (COLUMNS, COLUMNS + SHAPE):
        stop(f"{name}:1: expected the columns {','.join(COLUMNS)}, with or without {','.join(SHAPE)}")
    frames = []
    for number, row in enumerate(rows[1:], start=2):
        try:
            values = [float(text) for text in row[1:]]
        except ValueError as error:
            stop(f"{name}:{number}: {error}")
        if len(row) != len(rows[0]) or not all(map(math.isfinite, values)):
            stop(f"{name}:{number}: expected {len(rows[0])} finite numbers")
        frame = dict(path["frames"][min(len(frames), len(path["frames"]) - 1)])
        for index, vector in enumerate(VECTORS):
            frame[vector] = values[3 * index:3 * index + 3]
        frame["field_of_view"] = values[9]
        if rows[0] != COLUMNS:
            frame["shape"] = values[10:]
        frames.append(frame)
    if not frames:
        stop(f"{name}: no frames")
    return {**path, "frames": frames}


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "export":
        put(arguments[2], table_of(read_path(arguments[1])))
    elif len(arguments) == 4 and arguments[0] == "import":
        put(arguments[3], line_of(with_table(read_path(arguments[1]), arguments[2])))
    else:
        print(__doc__, file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main(sys.argv[1:])
