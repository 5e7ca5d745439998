# SPDX-License-Identifier: Apache-2.0
"""The part that the report's checks in a headless browser share: faults, screenshots, and the sizes of the window."""

from __future__ import annotations

from pathlib import Path

from .browser import Browser
from .errors import write_whole

DESKTOP, NARROW = (1200, 900), (360, 740)  # pixels; the narrow one is a phone


class Checker:
    def __init__(self, browser: Browser, pictures: Path):
        self.browser, self.pictures = browser, pictures
        self.wrong: list[str] = []

    def expect(self, holds: bool, what: str) -> None:
        print(f"{'ok   ' if holds else 'WRONG'} {what}")
        if not holds:
            self.wrong.append(what)

    def shot(self, name: str) -> None:
        write_whole(self.pictures / f"{name}.png", self.browser.screenshot())
