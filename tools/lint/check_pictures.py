#!/usr/bin/env python3
"""Check that no picture of the gallery is older than its deck or than the commands given with it.

    check_pictures.py [FOLDER]      exit 0: no fault, 1: faults; ./dev docs draws what is older
"""
import pathlib
import sys

import report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import gallery  # noqa: E402


def check(root):
    root = pathlib.Path(root)
    if not (root / gallery.PAGE).is_file():
        return []
    try:
        return list(gallery.faults(root))
    except gallery.GalleryError as error:
        return [str(error)]


if __name__ == "__main__":
    report.main("pictures", check)
