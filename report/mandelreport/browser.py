# SPDX-License-Identifier: Apache-2.0
"""Headless Chromium, driven by Playwright: makes the PDF and opens pages for checks."""

import contextlib
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Error, Page, sync_playwright

from .errors import Unavailable

NAMES = ("chromium", "chromium-browser", "google-chrome")
# WebGL 2 without a GPU: SwiftShader renders on the processor.
OPTIONS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
DESKTOP = {"width": 1200, "height": 900}  # pixels
START_SECONDS = 120
# Decodes all pictures, including those that are not visible.
DECODE = "Promise.all([...document.images].map((image) => image.decode().catch(() => 0))).then(() => 1)"


@contextlib.contextmanager
def opened(address: str) -> Iterator[tuple[Page, list[str]]]:
    """Opens an address in a new browser. Yields the page and a list that grows while the page is used: errors of
    scripts, errors and warnings on the console, and requests for anything but files and data URIs."""
    program = next((found for name in NAMES if (found := shutil.which(name))), None)
    if program is None:
        raise Unavailable("chromium is missing: tools/setup report installs it; --no-pdf makes only the page")
    problems: list[str] = []
    try:
        with sync_playwright() as playwright:
            # Chromium's sandbox does not work as root.
            browser = playwright.chromium.launch(
                executable_path=program, args=OPTIONS, chromium_sandbox=os.geteuid() != 0, timeout=1000 * START_SECONDS
            )
            page = browser.new_page(viewport=DESKTOP)
            page.set_default_timeout(1000 * START_SECONDS)
            page.on("pageerror", lambda error: problems.append(error.message))
            page.on("console", lambda said: said.type in ("error", "warning", "assert") and problems.append(f"console: {said.text}"))
            page.on("request", lambda of: of.url.startswith(("file:", "data:", "blob:")) or problems.append(f"network: {of.url}"))
            page.goto(address)
            yield page, problems
            browser.close()
    except Error as error:
        raise Unavailable(f"chromium: {error.message.partition(chr(10))[0]}") from error


def holds(page: Page, expression: str, seconds: float) -> bool:
    """Waits until the expression is true, at most for `seconds`. Returns false on timeout."""
    end = time.monotonic() + seconds
    while not page.evaluate(expression):  # the page's policy forbids wait_for_function
        if time.monotonic() > end:
            return False
        page.wait_for_timeout(100)
    return True


def pdf_of(page: Page) -> bytes:
    return page.pdf(print_background=True, prefer_css_page_size=True, outline=True, tagged=True)


def print_page(path: Path) -> bytes:
    """Returns the page as PDF."""
    with opened(path.absolute().as_uri()) as (page, _):
        page.evaluate(DECODE)
        return pdf_of(page)
