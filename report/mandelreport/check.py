# SPDX-License-Identifier: Apache-2.0
"""python -m mandelreport.check PAGE: checks the page in a headless browser.

Exit codes: 0 success, 1 a fault, 2 wrong arguments, 77 no browser. Screenshots go to --pictures."""

import argparse
import re
from pathlib import Path

from .browser import DECODE, DESKTOP, holds, opened, pdf_of
from .errors import InputError, run_program
from .page import APPENDIX, MAIN
from .viewer_check import NARROW, ViewerChecker

PAPER = 680  # pixels: A4 without its margins
MOST_PAGES = 12
FRONT_ONLY = "main > :not(#front), footer.page { display: none }"
SECTIONS = 1 + len(MAIN) + len(APPENDIX)
# The slider's description of a difference.
DIFFERENCE = re.compile(r"[\d,]+ of [\d,]+ pixels differ(: the same bytes\.|, [\d,]+ by more than 2/255, at most \d+/255\.)")


class PageChecker(ViewerChecker):
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
        checker = PageChecker(page, arguments.pictures, arguments.programs.absolute())
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
