#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""blender_path_test.py: a path is unchanged if it is converted to Blender's cameras and back."""
import json
import os
import re
import sys
import tempfile
import types
import unittest
from unittest import mock

from tool import TOOLS

import blender_path
from mandelreport.errors import InputError


def frame(number):
    return {"location": [1.5 + number, -0.25, 0.125], "look_at": [0.7 + number, 0.1, 0.5], "up": [0.1, 0.9, 0.2],
            "field_of_view": 1.25, "brightness": 1.5 + number}


PATH = {"format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": 30,
        "scene": {"detail": "by size", "shape": [0, 4, 8]}, "frames": [frame(n) for n in range(4)]}


# Fakes of the parts of Blender's interface that blender_path.py uses.
class Camera:
    def __init__(self):
        self.matrix_world = None
        self.data = types.SimpleNamespace(angle_y=None, sensor_fit=None, keyframe_insert=lambda what, frame: None)
        self.keys = {}

    def keyframe_insert(self, what, frame):
        self.keys[frame] = (self.matrix_world, self.data.angle_y)


def fake_blender():
    scene = types.SimpleNamespace(render=types.SimpleNamespace(fps=None, fps_base=1), frame_start=None, frame_end=None, camera=None,
                                  collection=types.SimpleNamespace(objects=types.SimpleNamespace(link=lambda it: None)))

    def frame_set(number):
        scene.camera.matrix_world, scene.camera.data.angle_y = scene.camera.keys[number]

    scene.frame_set = frame_set
    return types.SimpleNamespace(
        context=types.SimpleNamespace(scene=scene),
        data=types.SimpleNamespace(objects=types.SimpleNamespace(new=lambda name, data: Camera()),
                                   cameras=types.SimpleNamespace(new=lambda name: None)))


class BlenderTest(unittest.TestCase):
    def test_a_path_file_that_is_wrong_or_the_new_one_stays(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(sys.modules, bpy=fake_blender(), mathutils=types.SimpleNamespace()):
            path, link = os.path.join(folder, "path.json"), os.path.join(folder, "link.json")
            os.symlink(path, link)
            for text, new, why in ((json.dumps(PATH), link, "the path file itself"), ("[" * 100000, "new.json", "nested too deep"),
                                   ('{"frames": [{}]}', "new.json", "'location' is missing"), ('{"frames": []}', "new.json", "no frames")):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                with self.assertRaisesRegex(InputError, why):
                    blender_path.main(["save", path, new])
                with open(path, encoding="utf-8") as file:
                    self.assertEqual(file.read(), text)

    def test_cameras_and_back(self):
        bpy = fake_blender()
        blender_path.load(bpy, types.SimpleNamespace(Matrix=lambda rows: rows), PATH)
        scene = bpy.context.scene
        self.assertEqual((scene.render.fps, scene.frame_start, scene.frame_end), (30, 0, 3))
        new = blender_path.save(bpy, PATH)
        for was, now in zip(PATH["frames"], new["frames"], strict=True):
            self.assertEqual(now["location"], was["location"])
            self.assertAlmostEqual(now["field_of_view"], was["field_of_view"], places=12)
            gaze = blender_path.unit(blender_path.minus(was["look_at"], was["location"]))
            for a, b in zip(blender_path.unit(blender_path.minus(now["look_at"], now["location"])), gaze):
                self.assertAlmostEqual(a, b, places=12)
            # The camera's up vector is perpendicular to its gaze, and lies in the plane of the gaze and the path's up
            # vector.
            self.assertAlmostEqual(sum(a * b for a, b in zip(now["up"], gaze)), 0, places=12)
            self.assertGreater(sum(a * b for a, b in zip(now["up"], was["up"])), 0)
            self.assertEqual(now["brightness"], was["brightness"])

    def test_markers_are_a_places_file(self):
        bpy = fake_blender()
        blender_path.load(bpy, types.SimpleNamespace(Matrix=lambda rows: rows), PATH)
        scene = bpy.context.scene
        scene.frame_start = 1
        scene.timeline_markers = [types.SimpleNamespace(name=name, frame=frame)
                                  for name, frame in (("b", 3), ("tour", 2), ("a", 1))]
        header, first, tour, second = blender_path.places(bpy).splitlines()
        with open(os.path.join(TOOLS, "..", "flight", "path", "places.h"), encoding="utf-8") as file:
            self.assertIn(f'"{header},field_of_view,roll"', file.read())
        self.assertEqual(tour, "tour")
        for line, frame, time in ((first, 1, 0), (second, 3, 2 / 30)):
            *numbers, stay = line.split(",")
            numbers = [float(number) for number in numbers]
            was = PATH["frames"][frame]
            self.assertEqual((numbers[:3], stay), (was["location"], ""))
            self.assertAlmostEqual(numbers[6], time, places=9)
            gaze = blender_path.unit(blender_path.minus(was["look_at"], was["location"]))
            for a, b in zip(blender_path.minus(numbers[3:6], numbers[:3]), gaze):
                self.assertAlmostEqual(a, b, places=8)

    def test_a_unit_of_the_field_is_the_kernels(self):
        with open(os.path.join(TOOLS, "..", "core", "scene", "scene.h"), encoding="utf-8") as file:
            degrees = re.search(r"degrees_per_field = ([0-9.]+);", file.read()).group(1)
        self.assertEqual(float(degrees), blender_path.DEGREES_PER_FIELD)


if __name__ == "__main__":
    unittest.main()
