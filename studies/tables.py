# SPDX-License-Identifier: MIT
"""What the scripts beside this one share: reading a study's tables, and writing those of a page.

Not a program. Needs nothing but Python's standard library.
"""
import csv
import gzip
import os
import re
import sys


def rows_of(path):
    """The rows of a table, which may be compressed, or lie compressed beside its name."""
    if os.path.exists(path) and not path.endswith(".gz"):
        file = open(path, newline="", encoding="utf-8")
    else:
        file = gzip.open(path.removesuffix(".gz") + ".gz", "rt", newline="", encoding="utf-8")
    with file:
        return list(csv.DictReader(file))


def table(header, rows):
    """In Markdown."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def write_page(path, made):
    """Rewrites what stands between <!-- table: NAME --> and <!-- end -->.

    Made has the tables by name; None leaves the one that the page has.
    """
    with open(path, encoding="utf-8") as file:
        page = file.read()
    for name in re.findall(r"<!-- table: ([\w-]+) -->", page):
        if name not in made:
            sys.exit(f"{path}: there is no table {name}; there are {', '.join(made)}")
        if made[name] is not None:
            page = re.sub(rf"(<!-- table: {name} -->\n).*?(<!-- end -->)",
                          lambda m, text=made[name]: m[1] + text + m[2], page, flags=re.S)
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)
