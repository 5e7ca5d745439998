#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""links_test.py: every link of the documentation leads to an existing file or heading, and every page is linked."""
import os
import re
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
LINK = re.compile(r"(?:\[[^\]\n]*\]\(|<img src=\")([^)\"\s]+)[)\"]")


def pages(root):
    found = [os.path.join(root, name) for name in os.listdir(root) if name.endswith(".md")]
    for folder, _, names in os.walk(os.path.join(root, "docs")):
        found += [os.path.join(folder, name) for name in names if name.endswith(".md")]
    return sorted(found)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def anchors(text):
    """Returns the anchors of a page's headings, in GitHub's form."""
    found = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in found}


def targets(path):
    """Yields each link of a page as (link, file, anchor). Leaves out links to other sites."""
    for link in LINK.findall(read(path)):
        if re.match(r"[a-z]+:", link):
            continue
        file, _, anchor = link.partition("#")
        yield link, os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path, anchor


def broken(path):
    return [link for link, file, anchor in targets(path)
            if not os.path.exists(file) or (anchor and anchor not in anchors(read(file)))]


class LinksTest(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages(ROOT):
            with self.subTest(page=os.path.relpath(page, ROOT)):
                self.assertEqual(broken(page), [])

    def test_every_page_can_be_reached_from_the_readme(self):
        reached, to_read = set(), [os.path.join(ROOT, "README.md")]
        while to_read:
            page = to_read.pop()
            if page in reached or not page.endswith(".md") or not os.path.exists(page):
                continue
            reached.add(page)
            to_read += [file for _, file, _ in targets(page)]
        self.assertEqual(sorted(set(pages(ROOT)) - reached), [])

    def test_a_broken_link_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "page.md")
            with open(page, "w", encoding="utf-8") as file:
                file.write("# The one heading\n[a](page.md) [b](nothing.md) [c](#the-one-heading) [d](page.md#another)\n"
                           "<img src=\"nothing.png\" width=\"300\">\n")
            self.assertEqual(broken(page), ["nothing.md", "page.md#another", "nothing.png"])


if __name__ == "__main__":
    unittest.main()
