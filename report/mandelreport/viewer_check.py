# SPDX-License-Identifier: Apache-2.0
"""Checks the live viewer of a page in a headless browser: its pictures, its scenes, its keys and its address."""

import base64
import io
import json
import math
import subprocess
import time
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page

from .browser import DESKTOP, holds, opened
from .errors import write_whole
from .viewer import differing_fields, views

NARROW = {"width": 360, "height": 740}  # pixels; a phone
VIEWER_SECONDS = 300  # per picture, on a processor
SAVE_SECONDS = 30
SIZE = (320, 180)  # pixels of the viewer's picture
CLOSE = 1e-6  # largest difference of two numbers of the same view; parameter files are rounded
MOST_VISIBLE = {"exact": 0.002, "fast": 0.02}  # fraction of pixels that may differ visibly from bin/render's
# Unusual scenes to check, by fractal. Each scene sets sliders, by name.
ODD: dict[str, list[dict[str, float]]] = {
    "mandelbulb": [{"shape.2": 3}, {"shape.2": 2.5}, {"shape.2": 8.5}],
    "mandelbox": [{"shape.0": -1.5}],
    "julia": [{"shape.0": 0.1, "shape.1": -0.5, "shape.2": 0.3, "escape": -0.2}],
}


def same_view(a: str, b: str) -> bool:
    """Returns true if two parameter files describe the same view. The sizes of the pictures may differ."""

    def numbers(text: str) -> list[float]:
        lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
        return [float(word) for line in lines[:4] + lines[5:10] for word in line.split()]

    return all(math.isclose(x, y, abs_tol=CLOSE) for x, y in zip(numbers(a), numbers(b), strict=True))


class ViewerChecker:
    """`page`: the open page; `pictures`: the folder of screenshots; `wrong`: all faults."""

    def __init__(self, page: Page, pictures: Path, programs: Path):
        self.page, self.pictures, self.programs = page, pictures, programs
        self.wrong: list[str] = []
        self.address = self.shared = ""  # the part of an address after the page's name; the view that it shows

    def expect(self, right: bool, what: str) -> None:
        print(f"{'ok   ' if right else 'WRONG'} {what}")
        if not right:
            self.wrong.append(what)

    def shot(self, name: str) -> bytes:
        """Writes a PNG of the visible part of the page, and returns it."""
        return self.page.screenshot(path=self.pictures / f"{name}.png")

    def here(self) -> None:
        """Checks the viewer of the page that is open."""
        run = self.page.evaluate
        if not run("document.getElementById('viewer-canvas') !== null"):
            print("the page has no viewer")
            return
        self.expect(run("document.getElementById('viewer-none').hidden"), "the viewer runs in WebGL 2")
        run("document.getElementById('viewer-canvas').scrollIntoView()")
        for fractal in self._fractals():
            for number, odd in enumerate([{}, *ODD.get(fractal, [])]):
                for mode in ("exact", "fast"):
                    self._choose("viewer-fractal", fractal)
                    self._choose("viewer-size", "x".join(map(str, SIZE)))
                    self._choose("viewer-mode", mode)
                    for parameter, value in odd.items():
                        self._slide(parameter, value)
                    begin = time.monotonic()
                    whole = holds(self.page, "Viewer.idle()", VIEWER_SECONDS)
                    self.expect(
                        whole,
                        f"viewer, {fractal}, {odd or 'official'}, {mode}: complete after {time.monotonic() - begin:.0f} s "
                        f"({run('document.getElementById(`viewer-says`).textContent')})",
                    )
                    if whole:
                        self._against_render(fractal, mode, f"viewer-{fractal}-{mode}{f'-{number}' if odd else ''}")
        self._fly()
        self._views()

    def _fractals(self) -> list[str]:
        return self.page.evaluate("[...document.getElementById('viewer-fractal').options].map((o) => o.value)")

    def _slide(self, parameter: str, value: float) -> None:
        self.page.locator(f'[data-parameter="{parameter}"]').evaluate("(s, v) => { s.value = v; s.dispatchEvent(new Event('input')); }", value)

    def _choose(self, select: str, value: str) -> None:
        self.page.locator(f"#{select}").evaluate(
            """(s, v) => { if (![...s.options].some((o) => o.value === v)) s.add(new Option(v));
            s.value = v; s.dispatchEvent(new Event('change')); }""",
            value,
        )

    def _picture(self) -> bytes:
        return base64.b64decode(self.page.evaluate("Viewer.picture()").partition(",")[2])

    def _against_render(self, fractal: str, mode: str, name: str) -> None:
        """Compares the viewer's picture and scene with those of bin/render for the viewer's parameter file."""
        seen = self.pictures / f"{name}.png"
        write_whole(seen, self._picture())
        dat = self.pictures / f"{name}.dat"
        write_whole(dat, self.page.evaluate("Viewer.dat()").encode())
        render = self.programs / "render"
        if not render.exists():
            print(f"{render} is missing: the viewer's picture is not compared")
            return
        drawn = self.pictures / f"{name}-render.png"
        # The viewer renders no trial. Therefore bin/render must not render one either.
        command = [render, "--fractal", fractal, dat, "--precision", "float", "--mode", mode,
                   *(["--without", "trial"] if mode == "fast" else [])]
        printed = subprocess.run([*command, "--print-scene"], capture_output=True, text=True, check=False)
        if printed.returncode == 0:
            mine = self.page.evaluate("({ ...Viewer.fields(), miss: 'Infinity' })")
            other = differing_fields(mine, json.loads(printed.stdout))
            self.expect(not other, f"{name}: the scene's fields are bin/render's{': not ' + ', '.join(other) if other else ''}")
            mutant = differing_fields(mine | {"root_share": 1.5 * mine["root_share"]}, json.loads(printed.stdout))
            self.expect("root_share" in mutant, f"{name}: a wrong root share is detected")
        done = subprocess.run([*command, "--output", drawn], capture_output=True, text=True, check=False)
        self.expect(done.returncode == 0, f"bin/render renders the viewer's parameter file {done.stderr.strip()}")
        if done.returncode == 0:
            compared = subprocess.run([self.programs / "imgdiff", "--json", seen, drawn], capture_output=True, text=True, check=False)
            if not compared.stdout:  # pictures of different sizes
                self.expect(False, compared.stderr.strip())
                return
            found = json.loads(compared.stdout)
            visible, pixels = found["visibly_differing_pixels"], found["width"] * found["height"]
            self.expect(
                visible <= MOST_VISIBLE[mode] * pixels,
                f"viewer compared with bin/render --precision float --mode {mode}, {fractal}: {found['differing_pixels']} of {pixels} "
                f"pixels differ, {visible} by more than 2/255, at most {found['largest_difference']}/255",
            )

    def _views(self) -> None:
        """Checks that the buttons show the views, that the page's address contains the view, and that the picture can
        be saved."""
        run = self.page.evaluate
        files = {view["name"]: view["dat"] for view in views(self._fractals())}
        names = run("[...document.querySelectorAll('[data-view]')].map((button) => button.textContent.toLowerCase())")
        self.expect(sorted(names) == sorted(files), f"buttons for the views: {', '.join(names)}")
        run("document.getElementById('viewer-canvas').scrollIntoView()")
        for number, name in enumerate(names):
            self._jump(number)
            dat = run("Viewer.dat()")
            self.expect(same_view(dat, files[name]), f"the button {name} shows the view")
            self.expect(not same_view(dat, files[names[number - 1]]), f"the view {name} is not the view before it")
        self._choose("viewer-mode", "exact")  # unlike at the start
        kept = holds(self.page, 
            "(() => { const at = new URLSearchParams(location.hash.slice(1));"
            "return at.get('mode') === 'exact' && at.get('dat') === Viewer.dat().replace(/^#.*\\n/gm, ''); })()",
            VIEWER_SECONDS,
        )
        self.expect(kept, "the page's address contains the view")
        self.address, self.shared = run("location.hash"), run("Viewer.dat()")
        self._choose("viewer-mode", "fast")
        self._jump(0)
        holds(self.page, f"location.hash !== {json.dumps(self.address)}", VIEWER_SECONDS)
        run(f"location.hash = {json.dumps(self.address)}")
        back = holds(self.page, "document.getElementById('viewer-mode').value === 'exact'", 30)
        self.expect(back and same_view(run("Viewer.dat()"), self.shared), "another address shows another view")
        holds(self.page, "Viewer.idle() && !document.getElementById('viewer-picture').disabled", VIEWER_SECONDS)
        with self.page.expect_download(timeout=1000 * SAVE_SECONDS) as saved:
            self.page.locator("#viewer-picture").click()
        same = saved.value.path().read_bytes() == self._picture()
        self.expect(same and saved.value.suggested_filename == "view.png", "the button saves the picture")

    def _jump(self, number: int) -> None:
        self.page.evaluate(f"document.querySelectorAll('[data-view]')[{number}].click()")

    def elsewhere(self, page: Path) -> None:
        """Checks that another browser shows the same view at the same address, and another view without it."""
        if not self.address:
            return
        with opened(page.absolute().as_uri() + self.address) as (other, _):
            size = other.evaluate("[Viewer.fields().width, Viewer.fields().height]")
            mode = other.evaluate("document.getElementById('viewer-mode').value")
            same = same_view(other.evaluate("Viewer.dat()"), self.shared) and size == list(SIZE) and mode == "exact"
            self.expect(same, f"the address shows the same view in another browser: {mode}, {size[0]} x {size[1]}")
            visible = other.evaluate(
                "(() => { const r = document.getElementById('viewer-canvas').getBoundingClientRect();"
                "return r.bottom > 0 && r.top < innerHeight; })()"
            )
            self.expect(visible, "the page of this address opens at the viewer")
        with opened(page.absolute().as_uri()) as (other, _):
            self.expect(not same_view(other.evaluate("Viewer.dat()"), self.shared), "without the address, another view is shown")

    def _fly(self) -> None:
        """Checks that keys move the camera, that a drag turns it, and that the page reads an edited parameter file."""
        run = self.page.evaluate
        canvas, mouse = self.page.locator("#viewer-canvas"), self.page.mouse
        canvas.focus()
        before = run("JSON.stringify(Viewer.camera())")
        self.page.keyboard.down("w")
        moved = holds(self.page, f"JSON.stringify(Viewer.camera().eye) !== JSON.stringify({before}.eye)", 60)
        self.page.keyboard.up("w")
        self.expect(moved, "the key W moves the camera")
        place = canvas.bounding_box()
        mouse.move(place["x"] + 99, place["y"] + 99)
        mouse.down()
        mouse.move(place["x"] + 139, place["y"] + 99)
        mouse.up()
        turned = holds(self.page, f"JSON.stringify(Viewer.camera().forward) !== JSON.stringify({before}.forward)", 60)
        self.expect(turned, "a drag turns the camera")
        run("""(() => { const t = document.getElementById('viewer-dat'); t.value = t.value.replace(/(# field of view\\n).*/, '$11.25');
                        document.getElementById('viewer-go').click(); })()""")
        self.expect(run("Viewer.camera().field") == 1.25, "a parameter file is read back")
        run(
            """(() => { const s = document.querySelector('[data-parameter]'); s.value = s.max; s.dispatchEvent(new Event('input')); })()"""
        )
        holds(self.page, "Viewer.idle()", VIEWER_SECONDS)
        with Image.open(io.BytesIO(self.shot("viewer"))) as seen:
            place = run(
                "(() => { const r = document.getElementById('viewer-canvas').getBoundingClientRect();"
                "return [r.left, Math.max(0, r.top), r.right, Math.min(innerHeight, r.bottom)]; })()"
            )
            colours = seen.convert("RGB").crop(tuple(map(round, place))).getcolors(2**24) or []
        self.expect(len(colours) > 100, f"the screen shows the viewer's picture: {len(colours)} colours")
        self.page.set_viewport_size(NARROW)
        run("document.getElementById('viewer-live').scrollIntoView()")
        holds(self.page, "Viewer.idle()", VIEWER_SECONDS)
        self.shot("viewer-narrow")
        self.page.set_viewport_size(DESKTOP)

    def without_webgl(self, page: Path) -> None:
        """Checks that the page reports a missing WebGL 2."""
        with opened(page.absolute().as_uri(), "--disable-3d-apis") as (other, _):
            self.expect(
                other.evaluate("!document.getElementById('viewer-none') || !document.getElementById('viewer-none').hidden"),
                "without WebGL 2 the page reports that",
            )
