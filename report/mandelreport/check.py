# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport.check PAGE: checks the page in a headless browser, and its live viewer: pictures, keys, buttons and
address. tests/report/viewer_test.py checks that the viewer computes the values of the programs.

Exit codes: 0 success, 1 a fault, 2 wrong arguments, 77 no browser. Screenshots go to --pictures."""

import argparse
import base64
import json
import math
import re
import subprocess
from pathlib import Path

from playwright.sync_api import Page

from .browser import DECODE, DESKTOP, holds, opened, pdf_of
from .errors import InputError, output_of, run_program, write_whole
from .page import APPENDIX, MAIN
from .viewer import views

PAPER = 680  # pixels: A4 without its margins
MOST_PAGES = 12
FRONT_ONLY = "main > :not(#front), footer.page { display: none }"
SECTIONS = 1 + len(MAIN) + len(APPENDIX)
# The slider's description of a difference.
DIFFERENCE = re.compile(r"[\d,]+ of [\d,]+ pixels differ(: the same bytes\.|, [\d,]+ by more than 2/255, at most \d+/255\.)")
NARROW = {"width": 360, "height": 740}  # pixels; a phone
VIEWER_SECONDS = 300  # per picture, on a processor
SAVE_SECONDS = 30
CLOSE = 1e-6  # largest difference of two numbers of the same view; parameter files are rounded
MOST_VISIBLE = {"exact": 0.002, "fast": 0.02}  # fraction of pixels that may differ visibly from bin/render's


def same_view(a: str, b: str) -> bool:
    """Returns true if two parameter files describe the same view. The sizes of the pictures may differ."""

    def numbers(text: str) -> list[float]:
        lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
        return [float(word) for line in lines[:4] + lines[5:10] for word in line.split()]

    return all(math.isclose(x, y, abs_tol=CLOSE) for x, y in zip(numbers(a), numbers(b), strict=True))


class Checker:
    """`page`: the open page; `pictures`: the folder of screenshots; `wrong`: all faults."""

    def __init__(self, page: Page, pictures: Path, programs: Path):
        self.page, self.pictures, self.programs = page, pictures, programs
        self.wrong: list[str] = []

    def expect(self, right: bool, what: str) -> None:
        print(f"{'ok   ' if right else 'WRONG'} {what}")
        if not right:
            self.wrong.append(what)

    def shot(self, name: str) -> None:
        """Writes a PNG of the visible part of the page."""
        self.page.screenshot(path=self.pictures / f"{name}.png")

    def viewer(self) -> None:
        run = self.page.evaluate
        if not run("document.getElementById('viewer-canvas') !== null"):
            print("the page has no viewer")
            return
        self.expect(run("document.getElementById('viewer-none').hidden"), "the viewer runs in WebGL 2")
        run("document.getElementById('viewer-canvas').scrollIntoView()")
        fractals = run("[...document.getElementById('viewer-fractal').options].map((o) => o.value)")
        for fractal in fractals:
            for mode in MOST_VISIBLE:
                self._choose("viewer-fractal", fractal)
                self._choose("viewer-size", "320x180")
                self._choose("viewer-mode", mode)
                if holds(self.page, "Viewer.idle()", VIEWER_SECONDS):
                    self._against_render(fractal, mode)
                else:
                    self.expect(False, f"viewer, {fractal}, {mode}: no picture within {VIEWER_SECONDS} s")
        self._fly()
        self._views({view["name"]: view["dat"] for view in views(fractals)})

    def _choose(self, select: str, value: str) -> None:
        self.page.locator(f"#{select}").evaluate("(s, v) => { s.value = v; s.dispatchEvent(new Event('change')); }", value)

    def _picture(self) -> bytes:
        return base64.b64decode(self.page.evaluate("Viewer.picture()").partition(",")[2])

    def _against_render(self, fractal: str, mode: str) -> None:
        """Compares the viewer's picture with that of bin/render for the viewer's parameter file."""
        seen, dat, drawn = (self.pictures / f"viewer-{fractal}-{mode}{ending}" for ending in (".png", ".dat", "-render.png"))
        write_whole(seen, self._picture())
        write_whole(dat, self.page.evaluate("Viewer.dat()").encode())
        # The viewer renders no trial. Therefore bin/render must not render one either.
        command = [self.programs / "render", "--fractal", fractal, dat, "--precision", "float", "--mode", mode,
                   *(["--without", "trial"] if mode == "fast" else [])]
        subprocess.run([*command, "--output", drawn], check=True)
        found = json.loads(output_of(self.programs / "imgdiff", "--json", seen, drawn, codes=(0, 1)))
        visible, pixels = found["visibly_differing_pixels"], found["width"] * found["height"]
        self.expect(visible <= MOST_VISIBLE[mode] * pixels, f"viewer, {fractal}, {mode}: {visible} of {pixels} pixels differ visibly from bin/render's")

    def _views(self, files: dict[str, str]) -> None:
        """Checks that the buttons show the views, that the page's address contains the view, and that the picture can
        be saved."""
        run = self.page.evaluate
        names = run("[...document.querySelectorAll('[data-view]')].map((button) => button.textContent.toLowerCase())")
        self.expect(sorted(names) == sorted(files), f"buttons for the views: {', '.join(names)}")
        for number, name in enumerate(names):
            self._jump(number)
            self.expect(same_view(run("Viewer.dat()"), files[name]), f"the button {name} shows the view")
        self._choose("viewer-mode", "exact")  # unlike at the start
        self.expect(holds(self.page, "location.hash.includes('mode=exact')", VIEWER_SECONDS), "the page's address contains the mode")
        address, shared = run("location.hash"), run("Viewer.dat()")
        self._choose("viewer-mode", "fast")
        self._jump(0)
        holds(self.page, f"location.hash !== {json.dumps(address)}", VIEWER_SECONDS)
        run(f"location.hash = {json.dumps(address)}")
        back = holds(self.page, "document.getElementById('viewer-mode').value === 'exact'", 30)
        self.expect(back and same_view(run("Viewer.dat()"), shared), "an address shows its view")
        holds(self.page, "Viewer.idle() && !document.getElementById('viewer-picture').disabled", VIEWER_SECONDS)
        with self.page.expect_download(timeout=1000 * SAVE_SECONDS) as saved:
            self.page.locator("#viewer-picture").click()
        self.expect(saved.value.path().read_bytes() == self._picture(), "the button saves the picture")

    def _jump(self, number: int) -> None:
        self.page.evaluate(f"document.querySelectorAll('[data-view]')[{number}].click()")

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
        for name, size in (("viewer-narrow", NARROW), ("viewer", DESKTOP)):
            self.page.set_viewport_size(size)
            run("document.getElementById('viewer-live').scrollIntoView()")
            holds(self.page, "Viewer.idle()", VIEWER_SECONDS)
            self.shot(name)

    def whole(self) -> None:
        """Checks that nothing is broken, nothing overflows a narrow window, and every picture has a description."""
        run = self.page.evaluate
        run(DECODE)
        self.expect(run("[...document.images].every((i) => i.naturalWidth > 0)"), "every picture can be decoded")
        self.expect(run("[...document.images].every((i) => i.alt.length > 10)"), "every picture has an alternative text")
        self.expect(run("document.querySelectorAll('section').length") == SECTIONS, f"{SECTIONS} sections, the front page first")
        self.expect(run("document.querySelectorAll('#front .answer data').length") > 0, "the front page's answers have numbers")
        for name, size in (("desktop", DESKTOP), ("narrow", NARROW)):
            self.page.set_viewport_size(size)
            self.expect(
                run("document.documentElement.scrollWidth <= window.innerWidth"),
                f"{size['width']} pixels: nothing overflows ({run('document.documentElement.scrollWidth')} wide)",
            )
            run("window.scrollTo(0, 0)")
            self.shot(name)
        self.page.set_viewport_size(DESKTOP)

    def pages(self, style: str) -> int:
        """Returns the number of pages that the browser prints with an additional style sheet."""
        part = self.page.add_style_tag(content=style)
        pages = len(re.findall(rb"/Type\s*/Page\b", pdf_of(self.page)))
        part.evaluate("(style) => style.remove()")
        return pages

    def paper(self) -> None:
        """Checks that nothing overflows on paper, that page 2 begins with section 1, and that the main part is short.
        If anything overflows, the browser shrinks all pages."""
        run = self.page.evaluate
        self.page.emulate_media(media="print")
        self.page.set_viewport_size({"width": PAPER, "height": 1000})
        wide = run("document.documentElement.scrollWidth")
        self.expect(wide <= PAPER, f"paper: nothing overflows ({wide} of {PAPER} pixels)")
        breaks = run(f"getComputedStyle(document.querySelector('#{MAIN[0][0]} h2')).breakBefore")
        self.page.emulate_media(media="null")
        self.page.set_viewport_size(DESKTOP)
        self.expect(breaks == "page", "paper: section 1 begins on a new page")
        front = self.pages(FRONT_ONLY)
        self.expect(front == 1, f"paper: the front page has {front} pages, expected 1")
        pages = self.pages(".appendix, footer.page { display: none }")
        self.expect(0 < pages <= MOST_PAGES, f"paper: the main part has {pages} pages, at most {MOST_PAGES}")

    def slider(self) -> None:
        run = self.page.evaluate
        if not run("document.querySelector('.compare') !== null"):
            print("the page has no pictures: the slider is not checked")
            return
        run("""(() => { const slide = document.querySelector('.compare .slide input');
                        slide.value = 25; slide.dispatchEvent(new Event('input')); })()""")
        self.expect(
            run("document.querySelector('.compare .over').style.clipPath").startswith("inset(0px 75%"),
            "the slider uncovers the left quarter",
        )
        holds(self.page, "document.querySelector('.compare .said').textContent !== ''", 30)
        said = run("document.querySelector('.compare .said').textContent")
        self.expect(DIFFERENCE.fullmatch(said) is not None, f"the slider's difference: {said}")
        chosen = run("document.querySelector('.compare [data-side=right]').selectedOptions[0].text")
        self.expect(chosen.endswith("float, exact"), f"the slider first shows the effect of float: {chosen}")
        run("document.querySelector('.compare').scrollIntoView()")
        self.shot("slider")


def main() -> int:
    parser = argparse.ArgumentParser(prog="mandelreport.check", description=__doc__)
    parser.add_argument("page", type=Path)
    parser.add_argument("--programs", type=Path, default=Path("bin"))
    parser.add_argument("--pictures", type=Path, default=Path("build/report/check"))
    arguments = parser.parse_args()
    if not arguments.page.exists():
        raise InputError(f"{arguments.page}: file not found; make it with make report")
    with opened(arguments.page.absolute().as_uri()) as (page, problems):
        checker = Checker(page, arguments.pictures, arguments.programs.absolute())
        checker.whole()
        checker.paper()
        checker.slider()
        checker.viewer()
        checker.expect(
            not problems, f"no errors, warnings or requests{': ' + '; '.join(problems[:5]) if problems else ''}"
        )
    print(f"{len(checker.wrong)} wrong; screenshots in {arguments.pictures}")
    return 1 if checker.wrong else 0


if __name__ == "__main__":
    run_program("check", main)
