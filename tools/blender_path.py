#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Exchanges cameras between path files and Blender.

blender --python tools/blender_path.py -- load PATH.json                # make a camera with one keyframe per frame
blender FILE.blend --python tools/blender_path.py -- save PATH.json NEW.json   # PATH.json with the scene's camera
blender FILE.blend --python tools/blender_path.py -- places NEW.csv   # a places file: the camera at the scene's markers

The places file has a line for each marker of the timeline: the camera at the marker's frame, and the marker's time. A
marker with the name "tour" becomes a line "tour".

Axes are not converted: if y is up in the path, y is up in Blender, too. Blender's camera looks along the camera's own
-z axis, and the camera's y axis points to the picture's top. A field_of_view of 1 is a vertical angle of 65 degrees."""
import json
import math
import os
import sys
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
from mandelreport.errors import InputError, one_line, read_json, reading, write_whole

DEGREES_PER_FIELD = 65.0  # core/scene/scene.h
PLACES_HEADER = "location_x,location_y,location_z,look_at_x,look_at_y,look_at_z,second,stay"  # flight/path/places.h


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def matrix_of(frame):
    """Returns the matrix that converts the camera's coordinates to the world's, as rows of four numbers. Its columns
    are the camera's axes to the right, up and back, and the camera's position."""
    back = unit(minus(frame["location"], frame["look_at"]))
    right = unit(cross(frame["up"], back))
    columns = [right, cross(back, right), back, frame["location"]]
    return [[column[row] for column in columns] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def camera_of(matrix):
    """Returns the location, look_at and up of a path's frame for a matrix as described in matrix_of()."""
    column = [[matrix[row][index] for row in range(3)] for index in range(4)]
    return {"location": column[3], "look_at": minus(column[3], unit(column[2])), "up": unit(column[1])}


def load(bpy, mathutils, path):
    scene = bpy.context.scene
    scene.render.fps = path.get("frames_per_second", 30)
    scene.frame_start, scene.frame_end = 0, len(path["frames"]) - 1
    camera = bpy.data.objects.new("mandelmarch", bpy.data.cameras.new("mandelmarch"))
    camera.data.sensor_fit = "VERTICAL"
    camera.rotation_mode = "QUATERNION"
    scene.collection.objects.link(camera)
    scene.camera = camera
    for number, frame in enumerate(path["frames"]):
        camera.matrix_world = mathutils.Matrix(matrix_of(frame))
        camera.data.angle_y = math.radians(DEGREES_PER_FIELD * frame["field_of_view"])
        camera.keyframe_insert("location", frame=number)
        camera.keyframe_insert("rotation_quaternion", frame=number)
        camera.data.keyframe_insert("lens", frame=number)


def save(bpy, path):
    scene = bpy.context.scene
    frames = []
    for number in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(number)
        frame = dict(path["frames"][min(len(frames), len(path["frames"]) - 1)])
        frame.update(camera_of(scene.camera.matrix_world))
        frame["field_of_view"] = math.degrees(scene.camera.data.angle_y) / DEGREES_PER_FIELD
        frames.append(frame)
    return {**path, "frames": frames}


def places(bpy):
    """Returns the text of a places file."""
    scene = bpy.context.scene
    lines = [PLACES_HEADER]
    for marker in sorted(scene.timeline_markers, key=lambda marker: marker.frame):
        if marker.name == "tour":
            lines.append("tour")
            continue
        scene.frame_set(marker.frame)
        camera = camera_of(scene.camera.matrix_world)
        second = (marker.frame - scene.frame_start) / (scene.render.fps / scene.render.fps_base)
        lines.append(",".join(f"{value:.10g}" for value in camera["location"] + camera["look_at"] + [second]) + ",")
    return "\n".join(lines) + "\n"


def main(arguments):
    import bpy
    import mathutils
    if [len(arguments), *arguments[:1]] not in ([2, "load"], [3, "save"], [2, "places"]):
        sys.exit(__doc__)
    if arguments[0] == "places":
        write_whole(Path(arguments[1]), places(bpy).encode())
        return
    path = read_json(Path(arguments[1]), "a path file")
    with reading(arguments[1], "a path file"):
        if not [(matrix_of(frame), math.radians(frame["field_of_view"])) for frame in path["frames"]]:
            raise ValueError("has no frames")
    if arguments[0] == "load":
        load(bpy, mathutils, path)
    elif os.path.exists(arguments[2]) and os.path.samefile(arguments[1], arguments[2]):
        raise InputError(f"{arguments[2]}: the path file itself, expected another file")
    else:
        write_whole(Path(arguments[2]), json.dumps(save(bpy, path)).encode())


if __name__ == "__main__":
    try:
        main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    except (InputError, OSError) as failure:  # otherwise Blender's window remains open
        sys.exit(f"blender_path: {one_line(failure)}")
