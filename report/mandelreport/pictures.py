# SPDX-License-Identifier: Apache-2.0
"""Renders the official scenes on every backend with the built programs, once for each program, scene and setting."""

import dataclasses
import functools
import hashlib
import io
import json
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PIL import Image

from .blocks import data_uri
from .errors import output_of, read_json, write_whole

SIDE = 540  # pixels; the size that bench verifies and times
ROOT = Path(__file__).parents[2]
SCENES = {"mandelbulb": ROOT / "paramsBulb.dat", "mandelbox": ROOT / "paramsBox.dat"}
UNAVAILABLE = 77  # exit code: backend or device not available


@dataclass(frozen=True)
class Key:
    fractal: str
    precision: str
    mode: str
    backend: str

    def __str__(self) -> str:
        return f"{self.backend}, {self.precision}, {self.mode}"


@dataclass(frozen=True)
class Picture:
    """A rendered picture. `drawn`: its PNG file; `values`: if it is exact, its EXR file, in which imgdiff can compare
    all bits of colour and depth."""

    key: Key
    device: str
    drawn: Path
    values: Path | None

    @functools.cached_property
    def image(self) -> Image.Image:
        with Image.open(self.drawn) as image:
            return image.convert("RGB")

    @property
    def digest(self) -> str:
        return hashlib.sha256(self.image.tobytes()).hexdigest()


def encoded(image: Image.Image, kind: str, **options: Any) -> str:
    """Returns an image as a data URI. `kind`: webp, png or jpeg; `options`: of Pillow's encoder."""
    buffer = io.BytesIO()
    image.save(buffer, format=kind, **options)
    return data_uri(f"image/{kind}", buffer.getvalue())


class Cache:
    """Files of earlier calls, named by a digest of all their inputs."""

    def __init__(self, folder: Path):
        self.folder = folder

    def path(self, ending: str, *parts: object) -> Path:
        digest = hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()[:24]
        self.folder.mkdir(parents=True, exist_ok=True)
        return self.folder / (digest + ending)

    def value(self, make: Any, *parts: object) -> Any:
        """Returns the result of make(), which depends only on `parts`. Calls make() only if no result is stored for
        these parts, and stores the result as JSON."""
        path = self.path(".json", *parts)
        if not path.exists():
            write_whole(path, json.dumps(make()).encode())
        return json.loads(path.read_text(encoding="utf-8"))


class Studio:
    """Renders pictures with bin/render. `reasons`: for each picture that is missing, the reason; `failures`: the subset
    for which bin/render failed, other than because the backend or device is unavailable."""

    def __init__(self, programs: Path, cache: Cache):
        self.render = programs / "render"
        self.imgdiff = programs / "imgdiff"
        self.cache = cache
        self.reasons: dict[Key, str] = {}
        self.failures: dict[Key, str] = {}
        self.program = hashlib.sha256(self.render.read_bytes()).hexdigest() if self.there else ""

    @property
    def there(self) -> bool:
        return self.render.exists() and self.imgdiff.exists()

    @functools.cached_property
    def devices(self) -> str:
        """Returns bin/render's list of devices with their drivers, and of backends that have none."""
        if not self.there:
            return ""
        return subprocess.run([self.render, "--list-devices"], capture_output=True, text=True, check=False).stdout

    @property
    def backends(self) -> list[str]:
        """Returns the backends of bin/render, in its order."""
        return list(dict.fromkeys(line.split()[0] for line in self.devices.splitlines()))

    def _draw(self, key: Key, ending: str) -> Path | None:
        """Returns a picture file rendered by bin/render, or None if there is none; `reasons` then has the reason."""
        scene = SCENES[key.fractal]
        target = self.cache.path(ending, self.program, self.devices, scene.read_text(encoding="utf-8"), key, SIDE)
        refused, stats = (target.with_suffix(ending + more) for more in (".refused", ".stats"))
        if not (target.exists() and stats.exists()) and not refused.exists():
            print(f"report: rendering {key.fractal}, {key} ({ending[1:]})", file=sys.stderr)
            options = dataclasses.asdict(key) | {"size": f"{SIDE}x{SIDE}", "output": target, "stats": stats}
            command = [self.render, scene, *(word for name, value in options.items() for word in (f"--{name}", value))]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            lines = run.stderr.strip().splitlines()
            if run.returncode == UNAVAILABLE:
                write_whole(refused, (lines[-1] if lines else "unavailable").encode())
            elif run.returncode != 0:
                # The failure is not cached, because a later attempt may succeed.
                self.failures[key] = self.reasons[key] = lines[-1] if lines else f"exit code {run.returncode}"
                return None
        if refused.exists():
            self.reasons[key] = refused.read_text(encoding="utf-8")
            return None
        return target

    def picture(self, key: Key) -> Picture | None:
        drawn = self._draw(key, ".png")
        if drawn is None:
            return None
        stats = read_json(drawn.with_suffix(".png.stats"), "the stats of a picture; delete it")
        values = self._draw(key, ".exr") if key.mode == "exact" else None
        return Picture(key, stats["device"]["name"], drawn, values)

    def all(self, backends: Iterable[str]) -> list[Picture]:
        """Returns every picture that these backends can render here, in the order of the report."""
        if not self.there:
            return []
        keys = [
            Key(fractal, precision, mode, backend)
            for fractal in SCENES
            for mode in ("exact", "fast")
            for precision in ("double", "float")
            for backend in backends
        ]
        return [picture for key in keys if (picture := self.picture(key)) is not None]

    def compare(self, a: Path, b: Path) -> dict[str, Any]:
        """Returns imgdiff's comparison of two files. Its key `map` has a picture of the differences."""
        differences = self.cache.path(".png", "map", a.name, b.name)

        def compared() -> dict[str, Any]:
            return json.loads(output_of(self.imgdiff, "--json", a, b, "--map", differences, codes=(0, 1)))

        return self.cache.value(compared, "imgdiff", a.name, b.name) | {"map": differences}
