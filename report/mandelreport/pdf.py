# SPDX-License-Identifier: Apache-2.0
"""The page on paper. Chromium prints it: it knows the page's figures, grids and @page rules, margins and numbers included."""

from __future__ import annotations

from pathlib import Path

from .browser import Browser


def print_page(page: Path) -> bytes:
    with Browser() as browser:
        browser.open(page)
        # Pictures that are not seen are not decoded before.
        browser.run("Promise.all([...document.images].map((image) => image.decode().catch(() => 0))).then(() => 1)")
        return browser.pdf()
