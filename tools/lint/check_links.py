#!/usr/bin/env python3
"""Check that every relative link and picture of our Markdown pages leads to a file, and a heading.

    check_links.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import functools
import pathlib
import re

import report
from check_lines import tracked

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ +(.*?) *$", re.MULTILINE)
KEPT = re.compile(r'<a id="([^"]+)"></a>')  # the anchor of a heading that has another text now


def anchor(heading):
    """The name that a heading has in links: letters in lower case, hyphens for blanks."""
    shown = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", shown.lower()).replace(" ", "-")


@functools.cache
def anchors(page):
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    return {anchor(h) for h in HEADING.findall(text)} | set(KEPT.findall(text))


def check(root):
    root = pathlib.Path(root)
    faults = []
    for page in sorted(f for f in tracked(root) if f.suffix == ".md"):
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            for target in LINK.findall(line):
                if "://" in target:
                    continue
                name, _, heading = target.partition("#")
                file = (page.parent / name).resolve() if name else page
                where = f"{page.relative_to(root)}:{number}"
                if not file.exists():
                    faults.append(f"{where}: '{target}' is not there")
                elif heading and file.suffix == ".md" and heading not in anchors(file):
                    faults.append(f"{where}: '{target}': the page has no such heading")
    return faults


if __name__ == "__main__":
    report.main("links", check)
