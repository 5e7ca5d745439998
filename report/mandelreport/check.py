# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport.check PAGE: checks the page in a headless browser.

Exit codes: 0 success, 1 a fault, 2 wrong arguments, 77 no browser. Screenshots go to --pictures."""

from __future__ import annotations

import argparse
import json
import re
from pathlib import Path

from .browser import Browser
from .checker import DESKTOP, NARROW, Checker
from .errors import InputError, run_program, write_whole
from .page import APPENDIX, MAIN
from .viewer_check import ViewerChecker, without_webgl

PAPER = 680  # pixels: A4 without its margins
MOST_PAGES = 12
FRONT_ONLY = "main > :not(#front), footer.page { display: none }"
SECTIONS = 1 + len(MAIN) + len(APPENDIX)
# The slider's description of a difference.
DIFFERENCE = re.compile(r"[\d,]+ of [\d,]+ pixels differ(: the same bytes\.|, [\d,]+ by more than 2/255, at most \d+/255\.)")


class PageChecker(Checker):
    def page(self) -> None:
        """Checks that nothing is broken, nothing overflows a narrow window, and every picture has a description."""
        run = self.browser.run
        run("Promise.all([...document.images].map((image) => image.decode().catch(() => 0))).then(() => 1)")
        self.expect(run("[...document.images].every((i) => i.naturalWidth > 0)"), "every picture can be decoded")
        self.expect(run("[...document.images].every((i) => i.alt.length > 10)"), "every picture has an alternative text")
        self.expect(run("document.querySelectorAll('section').length") == SECTIONS, f"{SECTIONS} sections, the front page first")
        self.expect(run("document.querySelectorAll('#front .answer data').length") > 0, "the front page's answers have numbers")
        for name, (width, height) in (("desktop", DESKTOP), ("narrow", NARROW)):
            self.browser.size(width, height)
            self.expect(
                run("document.documentElement.scrollWidth <= window.innerWidth"),
                f"{width} pixels: nothing overflows ({run('document.documentElement.scrollWidth')} wide)",
            )
            run("window.scrollTo(0, 0)")
            self.shot(name)
        self.browser.size(*DESKTOP)

    def pages(self, style: str) -> int:
        """Returns the number of pages that the browser prints with an additional style sheet."""
        self.browser.run(f"document.head.append(Object.assign(document.createElement('style'), {{ id: 'part', textContent: {json.dumps(style)} }}))")
        pages = len(re.findall(rb"/Type\s*/Page\b", self.browser.pdf()))
        self.browser.run("document.getElementById('part').remove()")
        return pages

    def paper(self) -> None:
        """Checks that nothing overflows on paper, that page 2 begins with section 1, and that the main part is short.
        If anything overflows, the browser shrinks all pages."""
        run, call = self.browser.run, self.browser.call
        call("Emulation.setEmulatedMedia", media="print")
        self.browser.size(PAPER, 1000)
        wide = run("document.documentElement.scrollWidth")
        self.expect(wide <= PAPER, f"paper: nothing overflows ({wide} of {PAPER} pixels)")
        breaks = run(f"getComputedStyle(document.querySelector('#{MAIN[0][0]} h2')).breakBefore")
        call("Emulation.setEmulatedMedia", media="")
        self.browser.size(*DESKTOP)
        self.expect(breaks == "page", "paper: section 1 begins on a new page")
        front = self.pages(FRONT_ONLY)
        self.expect(front == 1, f"paper: the front page has {front} pages, expected 1")
        self.expect(self.pages(f"{FRONT_ONLY} #front p {{ font-size: 16pt }}") > 1, "paper: a front page that is too long is detected")
        pages = self.pages(".appendix, footer.page { display: none }")
        self.expect(0 < pages <= MOST_PAGES, f"paper: the main part has {pages} pages, at most {MOST_PAGES}")

    def slider(self) -> None:
        run = self.browser.run
        if not run("document.querySelector('.compare') !== null"):
            print("the page has no pictures: the slider is not checked")
            return
        run("""(() => { const slide = document.querySelector('.compare .slide input');
                        slide.value = 25; slide.dispatchEvent(new Event('input')); })()""")
        self.expect(
            run("document.querySelector('.compare .over').style.clipPath").startswith("inset(0px 75%"),
            "the slider uncovers the left quarter",
        )
        self.browser.wait("document.querySelector('.compare .said').textContent !== ''", 30)
        said = run("document.querySelector('.compare .said').textContent")
        self.expect(DIFFERENCE.fullmatch(said) is not None, f"the slider's difference: {said}")
        chosen = run("document.querySelector('.compare [data-side=right]').selectedOptions[0].text")
        self.expect(chosen.endswith("float, exact"), f"the slider first shows the effect of float: {chosen}")
        run("document.querySelector('.compare').scrollIntoView()")
        self.shot("slider")
        # Selects for the right side the picture that is on the left side.
        run("""(() => { const right = document.querySelector('.compare [data-side=right]');
                        right.selectedIndex = 0; right.dispatchEvent(new Event('change')); })()""")
        same = self.browser.wait("/^0 of .*: the same bytes\\.$/.test(document.querySelector('.compare .said').textContent)", 30)
        self.expect(same, "a picture compared with itself has the same bytes")


BROKEN = """<!DOCTYPE html><title>broken</title><img src="http://127.0.0.1:9/none.png">
<script>console.error("said"); throw new Error("thrown");</script>"""


def broken_page(checker: Checker) -> None:
    """Negative control: an uncaught error, a logged error and a request must be detected."""
    page = checker.pictures / "broken.html"
    write_whole(page, BROKEN.encode())
    with Browser() as browser:
        browser.open(page)
        browser.wait("false", 0.5)
        problems = " ".join(browser.problems())
    checker.expect(
        all(word in problems for word in ("said", "thrown", "network: http://127.0.0.1:9/none.png")),
        "faults of a broken page are detected",
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="mandelreport.check", description=__doc__)
    parser.add_argument("page", type=Path)
    parser.add_argument("--programs", type=Path, default=Path("bin"))
    parser.add_argument("--pictures", type=Path, default=Path("build/report/check"))
    arguments = parser.parse_args()
    if not arguments.page.exists():
        raise InputError(f"{arguments.page}: file not found; make it with make report")
    with Browser() as browser:
        checker = PageChecker(browser, arguments.pictures)
        viewer = ViewerChecker(checker, arguments.programs.absolute())
        browser.size(*DESKTOP)
        browser.open(arguments.page)
        checker.page()
        checker.paper()
        checker.slider()
        viewer.here()
        viewer.elsewhere(arguments.page)
        problems = browser.problems()
        checker.expect(
            not problems, f"no errors, warnings or requests{': ' + '; '.join(problems[:5]) if problems else ''}"
        )
    without_webgl(arguments.page, checker)
    broken_page(checker)
    print(f"{len(checker.wrong)} wrong; screenshots in {arguments.pictures}")
    return 1 if checker.wrong else 0


if __name__ == "__main__":
    run_program("check", main)
