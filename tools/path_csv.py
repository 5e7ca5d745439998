#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""path_csv.py export PATH.json FILE.csv
path_csv.py import PATH.json FILE.csv NEW.json

export writes a path file's cameras as a table, one line per frame: frame, x, y, z of location, look_at and up,
field_of_view, and, if a frame has one, the three numbers of its shape (line 7 of a parameter file). import writes
NEW.json: PATH.json with the table's cameras and shapes, in the order of the column frame. A frame keeps the other
members that PATH.json has for its number; a frame beyond PATH.json's last one gets those of the last. Tables from
spreadsheets are supported: with a byte-order mark or in UTF-16, with semicolons or tabs (and then decimal commas), with
empty lines.
Exit codes: 0 success, 1 a file cannot be written, 2 a file cannot be read or is invalid."""
import codecs
import csv
import io
import json
import math
import sys

from table_file import put_file

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
    """Returns the text of a path file, with a line for each frame, as flythrough writes it."""
    head = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in path.items() if key != "frames"]
    frames = ",\n".join(json.dumps(frame) for frame in path["frames"])
    return "{\n" + ",\n".join(head) + ',\n"frames": [\n' + frames + "\n]\n}\n"


def table_of(path):
    changes = any("shape" in frame for frame in path["frames"])
    lines = [",".join(COLUMNS + SHAPE * changes)]
    for number, frame in enumerate(path["frames"]):
        numbers = [value for name in VECTORS for value in frame[name]] + [frame["field_of_view"]]
        if changes:
            numbers += frame.get("shape", path["scene"]["shape"])
        lines.append(",".join([str(number)] + [repr(value) for value in numbers]))
    return "\n".join(lines) + "\n"


def rows_of(name):
    """Returns those lines of a table that are not empty, as (number of the line, fields). Decimal commas become
    points."""
    try:
        with open(name, "rb") as file:
            data = file.read()
        text = data.decode("utf-16" if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE) else "utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        stop(f"{name}: {error}")
    head = next((line for line in text.splitlines() if line.strip()), "")
    separator = next((c for c in ";\t" if c in head), ",")
    try:
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
        rows = [(reader.line_num, [field.strip() for field in row]) for row in reader]
    except csv.Error as error:
        stop(f"{name}: {error}")
    if separator != ",":
        rows = [(number, [field.replace(",", ".") for field in row]) for number, row in rows]
    return [(number, row) for number, row in rows if any(row)]


def numbers_of(row, width, place):
    """Returns the frame number of a line, and the line's other numbers."""
    try:
        values = [float(text) for text in row]
    except ValueError as error:
        stop(f"{place}: {error}")
    if len(row) != width or not all(map(math.isfinite, values)):
        stop(f"{place}: expected {width} finite numbers")
    if values[0] < 0 or values[0] != int(values[0]):
        stop(f"{place}: the frame is {row[0]}, expected a whole number from 0")
    return int(values[0]), values[1:]


def with_table(path, name):
    rows = rows_of(name)
    if not rows or rows[0][1] not in (COLUMNS, COLUMNS + SHAPE):
        stop(f"{name}:{rows[0][0] if rows else 1}: expected the columns {','.join(COLUMNS)}, with or without {','.join(SHAPE)}")
    columns = rows[0][1]
    table = {}
    for number, row in rows[1:]:
        frame, values = numbers_of(row, len(columns), f"{name}:{number}")
        if frame in table:
            stop(f"{name}:{number}: frame {frame} is there twice")
        table[frame] = values
    if not table:
        stop(f"{name}: no frames")
    frames = []
    for number, values in sorted(table.items()):
        frame = dict(path["frames"][min(number, len(path["frames"]) - 1)])
        for index, vector in enumerate(VECTORS):
            frame[vector] = values[3 * index:3 * index + 3]
        frame["field_of_view"] = values[9]
        if columns != COLUMNS:
            frame["shape"] = values[10:]
        frames.append(frame)
    return {**path, "frames": frames}


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "export":
        put_file(table_of(read_path(arguments[1])), arguments[2])
    elif len(arguments) == 4 and arguments[0] == "import":
        put_file(line_of(with_table(read_path(arguments[1]), arguments[2])), arguments[3])
    else:
        print(__doc__, file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main(sys.argv[1:])
