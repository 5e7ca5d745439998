# SPDX-License-Identifier: Apache-2.0
"""Prints the page with Chromium, which supports the page's figures, grids and @page rules with margins and page
numbers."""

from __future__ import annotations

from pathlib import Path

from .browser import Browser


def print_page(page: Path) -> bytes:
    with Browser() as browser:
        browser.open(page)
        # Decode all pictures, including those that are not visible.
        browser.run("Promise.all([...document.images].map((image) => image.decode().catch(() => 0))).then(() => 1)")
        return browser.pdf()
