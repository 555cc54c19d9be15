#!/usr/bin/env python3
"""Check that docs/python.ipynb is what tools/docs/notebook.py makes of docs/python.md.

    check_notebook.py [FOLDER]      exit 0: no fault, 1: it is not
"""
import pathlib
import sys

import report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import notebook  # noqa: E402


def check(root):
    page, made = (pathlib.Path(root) / name for name in (notebook.PAGE, notebook.NOTEBOOK))
    if not page.is_file():
        return []
    wanted = notebook.notebook(page.read_text(encoding="utf-8"))
    if made.is_file() and made.read_text(encoding="utf-8") == wanted:
        return []
    return [f"{notebook.NOTEBOOK}: it is not what {notebook.PAGE} says: ./dev docs"]


if __name__ == "__main__":
    report.main("notebook", check)
