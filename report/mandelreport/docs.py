# SPDX-License-Identifier: Apache-2.0
"""Passages of the project's own documentation, so that the report cites and does not repeat it."""

from __future__ import annotations

import re

import markdown
from markupsafe import Markup

from .errors import InputError
from .pictures import ROOT


def _html(text: str) -> Markup:
    html = markdown.markdown(text, extensions=["tables", "sane_lists"], output_format="html")
    # Links of the documentation lead to files that this page does not have beside it.
    return Markup(re.sub(r'<a href="(?!https?:)[^"]*">(.*?)</a>', r"\1", html, flags=re.S))


def _read(file: str) -> str:
    try:
        return (ROOT / file).read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{file}: it cannot be read: {error.strerror}") from None


def chapter(file: str, title: str) -> Markup:
    """What stands under the heading `title`, up to the next heading of its level or above."""
    found = re.search(rf"^(#+) {re.escape(title)}\n(.*?)(?=^#{{1,2}} |\Z)", _read(file), re.M | re.S)
    if not found:
        raise InputError(f"{file}: no heading '{title}', which the report cites")
    # Words in capitals alone in a line keep a place for what a later change fills in.
    return _html(re.sub(r"^[A-Z_]+$", "", found[2], flags=re.M))
