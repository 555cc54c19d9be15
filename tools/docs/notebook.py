#!/usr/bin/env python3
"""docs/python.md as a notebook, and as what a test runs.

    notebook.py                        writes docs/python.ipynb
    notebook.py --run SLUICE FOLDER    runs all blocks of the page in FOLDER: those in `sh` with
                                       SLUICE as the command, then those in `python` as one program
"""
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE, NOTEBOOK = "docs/python.md", "docs/python.ipynb"
PART = re.compile(r"^```(\w*)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)


def parts(text):
    """[(language or None for prose, text)] in their order."""
    found, at = [], 0
    for match in PART.finditer(text):
        language, block = match.groups()
        if language not in ("sh", "python"):
            continue
        found += [(None, text[at:match.start()].strip("\n")), (language, block.rstrip("\n"))]
        at = match.end()
    found.append((None, text[at:].strip("\n")))
    return [(language, block) for language, block in found if block]


def cell(number, language, block):
    if language == "sh":  # commands run from the root of the project
        block = "\n".join("!" + line for line in block.splitlines())
    made = {"cell_type": "markdown" if language is None else "code", "id": f"part-{number}",
            "metadata": {}, "source": block.splitlines(keepends=True)}
    if language is not None:
        made |= {"execution_count": None, "outputs": []}
    return made


def notebook(text):
    """The text of the notebook."""
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    cells = [cell(n, *part) for n, part in enumerate(parts(text))]
    return json.dumps({"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4,
                       "nbformat_minor": 5}, indent=1, ensure_ascii=False) + "\n"


def run(sluice, folder):
    """Runs the page; ends with the status and the words of what fails."""
    text = (ROOT / PAGE).read_text(encoding="utf-8")
    for line in "\n".join(b for language, b in parts(text) if language == "sh").splitlines():
        words = [sluice, *(str(ROOT / w) if w.endswith(".ups") else w for w in line.split()[1:])]
        subprocess.run([*words, "--progress", "none", "--quiet"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
    program = "\n".join(block for language, block in parts(text) if language == "python")
    subprocess.run([sys.executable, "-B", "-c", program], cwd=folder, check=True,
                   env=os.environ | {"PYTHONPATH": str(ROOT / "tools"), "MPLBACKEND": "Agg"})


def main():
    if sys.argv[1:2] == ["--run"] and len(sys.argv) == 4:
        pathlib.Path(sys.argv[3]).mkdir(parents=True, exist_ok=True)
        run(str(pathlib.Path(sys.argv[2]).resolve()), sys.argv[3])
    elif len(sys.argv) == 1:
        text = (ROOT / PAGE).read_text(encoding="utf-8")
        (ROOT / NOTEBOOK).write_text(notebook(text), encoding="utf-8")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
