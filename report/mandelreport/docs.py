# SPDX-License-Identifier: Apache-2.0
"""Passages of the project's documentation and sources that the report quotes."""

import re

import markdown
from markupsafe import Markup

from .errors import InputError
from .pictures import ROOT


def _html(text: str) -> Markup:
    html = markdown.markdown(text, extensions=["tables", "sane_lists"], output_format="html")
    # Replaces links to files by their text, because the page does not include these files.
    return Markup(re.sub(r'<a href="(?!https?:)[^"]*">(.*?)</a>', r"\1", html, flags=re.S))


def _read(file: str) -> str:
    try:
        return (ROOT / file).read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}") from None


def chapter(file: str, title: str) -> Markup:
    """Returns the text under the heading `title`, up to the next heading of its level or above."""
    found = re.search(rf"^(#+) {re.escape(title)}\n(.*?)(?=^#{{1,2}} |\Z)", _read(file), re.M | re.S)
    if not found:
        raise InputError(f"{file}: the heading '{title}', which the report quotes, is missing")
    # Removes lines that have only capitals: placeholders for later changes.
    return _html(re.sub(r"^[A-Z_]+$", "", found[2], flags=re.M))


def code(file: str, begin: str) -> str:
    """Returns the lines of a source file from the one that contains `begin` to the next line that is only a closing
    brace, without that line's indentation."""
    found = re.search(rf"^[^\n]*{re.escape(begin)}.*?^([ \t]*)\}}$", _read(file), re.M | re.S)
    if not found:
        raise InputError(f"{file}: the line '{begin}', which the report quotes, is missing")
    return re.sub(rf"^{found[1]}", "", found[0], flags=re.M)
