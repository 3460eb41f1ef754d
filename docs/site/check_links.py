#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Every link of a built site leads somewhere: to a file, and on the documents' pages to a place in it; and nothing is
loaded from elsewhere. usage: check_links.py FOLDER"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADS = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
NOT_LOADED = {"canonical", "alternate", "next", "prev", "edit"}  # relations of <link>


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.loads, self.places = [], [], set()

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.places.update(filter(None, (given.get("id"), given.get("name"))))
        for name in ("href", "src"):
            if given.get(name) is None or given.get("rel") in NOT_LOADED:
                continue
            self.links.append(given[name])
            if (tag, name) in LOADS:
                self.loads.append(given[name])


def read(file):
    page = Page()
    page.feed(file.read_text(errors="replace"))
    return page


def faults(root):
    pages = {file: read(file) for file in root.rglob("*.html")}
    for file, page in pages.items():
        foreign = root / "page" in file.parents or root / "api" in file.parents  # whose anchors are made by scripts
        for link in page.loads:
            if urlsplit(link).scheme in ("http", "https") or link.startswith("//"):
                yield f"{file.relative_to(root)}: loads {link}"
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or link.startswith("//"):
                continue
            to = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if to.is_dir():
                to = to / "index.html"
            if not to.is_file():
                yield f"{file.relative_to(root)}: {link} leads nowhere"
            elif parts.fragment and not foreign and to in pages and root / "page" not in to.parents:
                if unquote(parts.fragment) not in pages[to].places and parts.fragment != "__tabbed":
                    yield f"{file.relative_to(root)}: {link}: there is no such place"


root = Path(sys.argv[1]).resolve()
count = len(list(root.rglob("*.html")))
found = list(faults(root))
print("\n".join(found[:50]))
print(f"{count} pages, {len(found)} faults")
sys.exit(1 if found or count < 50 else 0)
