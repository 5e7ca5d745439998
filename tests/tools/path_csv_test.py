#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""path_csv_test.py: a path is unchanged if it is converted to a table and back, or to Blender's cameras and back."""
import json
import math
import os
import re
import types
import unittest

from tool import TOOLS, ToolTest

import blender_path


def frame(number):
    return {"location": [1.5 + number, -0.25, 0.125], "look_at": [0.7 + number, 0.1, 0.5], "up": [0.1, 0.9, 0.2],
            "field_of_view": 1.25, "brightness": 1.5 + number}


PATH = {"format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": 30,
        "scene": {"detail": "by size", "shape": [0, 4, 8]}, "frames": [frame(n) for n in range(4)]}


class TableTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("path.json", json.dumps(PATH))

    def test_a_table_and_back(self):
        self.assertEqual(self.run_tool("path_csv.py", "export", "path.json", "path.csv").returncode, 0)
        self.assertEqual(self.read("path.csv").splitlines()[1], "0,1.5,-0.25,0.125,0.7,0.1,0.5,0.1,0.9,0.2,1.25")
        self.assertEqual(self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json").returncode, 0)
        self.assertEqual(json.loads(self.read("new.json")), PATH)

    def test_a_changed_table_changes_its_frames_alone(self):
        self.run_tool("path_csv.py", "export", "path.json", "path.csv")
        self.write("path.csv", self.read("path.csv").replace("2,3.5,", "2,9.5,"))
        self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json")
        new = json.loads(self.read("new.json"))
        self.assertEqual([n for n in range(4) if new["frames"][n] != PATH["frames"][n]], [2])
        self.assertEqual(new["frames"][2]["location"][0], 9.5)

    def test_a_shape_that_changes_is_in_the_table(self):
        frames = [{**frame(n), "shape": [0, 4, 8 - n]} for n in range(3)]
        self.write("path.json", json.dumps({**PATH, "frames": frames}))
        self.run_tool("path_csv.py", "export", "path.json", "path.csv")
        table = self.read("path.csv")
        self.assertTrue(table.splitlines()[0].endswith(",field_of_view,shape_1,shape_2,shape_3"))
        self.write("path.csv", table.replace(",0,4,7\n", ",0,4,7.5\n"))
        self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json")
        self.assertEqual([f["shape"] for f in json.loads(self.read("new.json"))["frames"]], [[0, 4, 8], [0, 4, 7.5], [0, 4, 6]])

    def test_a_table_of_a_spreadsheet_is_the_same_path(self):
        self.run_tool("path_csv.py", "export", "path.json", "path.csv")
        good = self.read("path.csv")
        head, *lines = good.splitlines()
        semicolons = good.replace(",", ";")
        for what, text in (("lines in another order", "\n".join([head, *reversed(lines)]) + "\n"),
                           ("a byte-order mark", "\ufeff" + good), ("an empty line at the end", good + "\n"),
                           ("commas alone in a line", good + "," * 10 + "\n"), ("an empty line before", "\n" + good),
                           ("semicolons", semicolons), ("decimal commas", semicolons.replace(".", ",")),
                           ("UTF-16", good.replace(",", "\t")), ("tabs", good.replace(",", "\t")),
                           ("ends of lines of Windows", good.replace("\n", "\r\n")),
                           ("quotes", '"' + head.replace(",", '","') + '"\n' + "\n".join(lines)),
                           ("all of Excel", "\ufeff" + semicolons.replace(".", ",").replace("\n", "\r\n") + "\r\n")):
            self.write("path.csv", text, "utf-16" if what == "UTF-16" else "utf-8")
            done = self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json")
            self.assertEqual((done.returncode, done.stderr), (0, ""), what)
            self.assertEqual(json.loads(self.read("new.json")), PATH, what)

    def test_frames_that_are_left_out_are_no_more(self):
        self.run_tool("path_csv.py", "export", "path.json", "path.csv")
        lines = self.read("path.csv").splitlines()
        self.write("path.csv", "\n".join([lines[0], lines[4], lines[2]]) + "\n")
        self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json")
        self.assertEqual(json.loads(self.read("new.json"))["frames"], [PATH["frames"][1], PATH["frames"][3]])

    def test_bad_tables_are_one_line(self):
        self.run_tool("path_csv.py", "export", "path.json", "path.csv")
        good = self.read("path.csv")
        for bad, said in ((good.replace("\n2,", "\n1,"), "path.csv:4: frame 1 is there twice"),
                          (good.replace("\n2,", "\n1.5,"), "path.csv:4: the frame is 1.5"),
                          (good.replace("\n2,", "\n,"), "path.csv:4:"),
                          (good.replace("frame,", "picture,"), "path.csv:1:"), (good.replace("3.5", "nan"), "path.csv:4:"),
                          (good.replace("3.5", "x"), "path.csv:4:"), ("\n".join(good.splitlines()[:1]), "no frames")):
            self.write("path.csv", bad)
            done = self.run_tool("path_csv.py", "import", "path.json", "path.csv", "new.json")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("new.json")))
        self.assertEqual(self.run_tool("path_csv.py", "export", "missing.json", "x.csv").returncode, 2)


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
            self.assertIn(f'"{header}"', file.read())
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

    def test_the_axes_are_a_rotation(self):
        rows = blender_path.matrix_of(frame(0))
        columns = [[rows[r][c] for r in range(3)] for c in range(3)]
        for i in range(3):
            for j in range(3):
                self.assertAlmostEqual(sum(a * b for a, b in zip(columns[i], columns[j])), float(i == j), places=12)
        self.assertAlmostEqual(math.fsum(a * b for a, b in zip(blender_path.cross(columns[0], columns[1]), columns[2])), 1,
                               places=12)


if __name__ == "__main__":
    unittest.main()
