#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""options_test.py BIN SOURCE: every option of flythrough's commands, and of each thing that render does, either changes
what comes out or is refused in one line that names the option."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
FRAME = {"look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1}
PATH = {
    "format": "mandelmarch path 1", "fractal": "mandelbulb", "frames_per_second": 30,
    "scene": {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2},
}
PLACES = "location_x,location_y,location_z,look_at_x,look_at_y,look_at_z,second,stay\n1.6,1.6,1.6,0,0,0,0,0.1\n"
# Values with which an option has an effect. An option that is not here is a flag.
VALUES = {
    "--authors": "a", "--backend": "reference", "--chapter": "passages", "--device": "9", "--estimate": "original",
    "--every": "2", "--eyes": "0.1", "--fps": "25", "--fractal": "box", "--frames": "3", "--from": "0.05", "--json": "audit.json",
    "--look": "lagoon", "--map": "map.json", "--mode": "exact", "--output": "other.mkv", "--params": "changed.dat",
    "--pixel": "5,6", "--places": "places.csv", "--power": "7", "--precision": "double", "--projection": "equirectangular",
    "--region": "0,0,8,8", "--samples": "2", "--scale": "2", "--seed": "2", "--segments": "0-0", "--simd-width": "1",
    "--size": "48x32", "--stats": "other.json", "--still-format": "jpeg", "--stills": "stills", "--summary": "summary.json",
    "--threads": "1", "--title": "t", "--to": "0.1", "--without": "hull",
}
VALUES_OF_RENDER = VALUES | {"--estimate": "conservative", "--json": None, "--mode": "fast", "--output": "b.bmp",
                             "--precision": "float"}


def run(folder, *words):
    return subprocess.run([f"{BIN}/{words[0]}", *words[1:]], cwd=folder, capture_output=True, text=True, check=False)


def options_of(*command):
    """Returns the options that a command's help lists."""
    return set(re.findall(r"--[a-z-]+", " ".join(re.findall(r"^ +(-.*?)(?: .*)?$", run(".", *command, "--help").stdout, re.M))))


class OptionsTest(unittest.TestCase):
    def outcome(self, words, broken=False):
        """Runs a command in a new folder. Returns its exit code, its words without times, its files, and its stderr."""
        with tempfile.TemporaryDirectory() as folder:
            frames = [{"location": [4 + 0.02 * i, 3, 3 + (i == 7 and broken)], **FRAME} for i in range(20)]
            Path(folder, "path.json").write_text(json.dumps(PATH | {"frames": frames}), encoding="utf-8")
            Path(folder, "places.csv").write_text(PLACES, encoding="utf-8")
            official = Path(SOURCE, "paramsBulb.dat").read_text(encoding="utf-8")
            Path(folder, "changed.dat").write_text(official.replace("0 4.0 8.0", "0 4.0 7.0"), encoding="utf-8")
            done = run(folder, *words)
            files = {path.relative_to(folder): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}
            for name in files:
                if "stats" in name.name:  # times change
                    files[name] = re.sub(rb"[0-9]+\.[0-9e-]+", b"", files[name])
            output = re.sub(r".*(seconds|plan:|planning).*|[0-9.]+ s\b|[0-9.]+ frames/s", "", done.stdout + done.stderr)
            return done.returncode, output, files, done.stderr

    def check(self, words, options, taken, values):
        """Checks that an option of `taken` changes what the command does or is refused, and any other is refused."""
        plain = {}
        for option in sorted(options - {"--help", "--version", "--no-isolation"}):
            other = list(words)
            if option in other:  # its value in `words` is replaced
                del other[other.index(option) : other.index(option) + (2 if values.get(option) else 1)]
            broken = option == "--force" and option in taken
            if broken not in plain:
                plain[broken] = self.outcome(words, broken)
            found = self.outcome([*other, option, *filter(None, [values.get(option)])], broken)
            with self.subTest(words=words, option=option):
                refused = found[0] == 2 and found[3].count("\n") == 1 and option in found[3]
                self.assertIn(plain[broken][0], (0, 1), plain[broken][3])
                self.assertTrue(refused or (option in taken and found[:3] != plain[broken][:3]), found)

    def test_flythrough(self):
        small = ["--size", "32x16", "--backend", "openmp", "--threads", "1"]
        # These segments are behind the film's end, so a run leaves only the description of the film in a folder.
        none = ["--segments", "9-9"]
        commands = {"plan": ["new.json", "--frames", "2"], "audit": ["path.json"], "render": ["path.json", *none],
                    "preview": ["path.json", *none], "film": ["--frames", "2", *none]}
        every = set().union(*(options_of("flythrough", command) for command in commands))
        self.assertGreater(len(every), 30)
        for command, words in commands.items():
            own = options_of("flythrough", command)
            unseen = {"--threads"}  # changes times only
            if command == "film":  # its options are those of the commands that it consists of; planning takes long
                self.assertEqual(own, (options_of("flythrough", "plan") | options_of("flythrough", "render")) - {"--force"})
                unseen = own
            if command in ("plan", "audit"):  # these change how many pixels are off, which are none in such small pictures
                unseen |= {"--look", "--precision", "--projection", "--samples", "--size"}
            self.check(["flythrough", command, *words, *small], every - (own & unseen), own, VALUES)

    def test_render(self):
        every = options_of("render")
        scene = ["--fractal", "bulb", "--size", "24x16"]
        for words in ([*scene, "--backend", "openmp", "--output", "a.bmp", "--stats", "stats.json"],
                      [*scene, "--trace", "--pixel", "3,4"], [*scene, "--print-scene"], ["--list-devices"], ["--list-fractals"]):
            self.check(["render", *words], every - set(word for word in words if word not in VALUES), every, VALUES_OF_RENDER)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
