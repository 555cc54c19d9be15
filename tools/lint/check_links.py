#!/usr/bin/env python3
"""Check that every relative link and picture of our Markdown pages leads to a file.

    check_links.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re

import report
from check_lines import tracked

LINK = re.compile(r"\]\(([^)\s]+)\)")


def check(root):
    root = pathlib.Path(root)
    faults = []
    for page in sorted(f for f in tracked(root) if f.suffix == ".md"):
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            for target in LINK.findall(line):
                if "://" in target or target.startswith("#"):
                    continue
                if not (page.parent / target.split("#")[0]).exists():
                    faults.append(f"{page.relative_to(root)}:{number}: '{target}' is not there")
    return faults


if __name__ == "__main__":
    report.main("links", check)
