#!/usr/bin/env python3
"""Check the heads of the decks of inputs/, and that the index of each folder is that of the heads.

tools/docs/deck_pages.py says what a head has, and writes the indexes (inputs/ice/README.md).

    check_decks.py [FOLDER]      exit 0: no fault, 1: faults
"""
import pathlib
import sys

import report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import deck_pages  # noqa: E402


def check(root):
    root = pathlib.Path(root)
    faults = []
    for folder in sorted({deck.parent for deck in (root / "inputs").glob("*/*.ups")}):
        page = folder / deck_pages.PAGE
        where = page.relative_to(root).as_posix()
        if folder.name not in deck_pages.SUBJECTS:
            faults.append(f"{where}: the folder has no subjects in tools/docs/deck_pages.py")
            continue
        try:
            wanted = deck_pages.page(root, folder.name)
        except deck_pages.HeadFault as fault:
            faults.append(str(fault))
            continue
        if not page.is_file() or page.read_text(encoding="utf-8") != wanted:
            faults.append(f"{where}: it is not what the heads of the decks say: ./dev docs")
    return faults


if __name__ == "__main__":
    report.main("decks", check)
