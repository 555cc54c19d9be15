#!/usr/bin/env python3
"""Check the form of our sources: line and file lengths, tabs, unfinished markers, purpose line.

A file has about 400 lines (`--long` lists those with more: is each one idea?) and never over 800.

    check_lines.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
    check_lines.py --long        files over 400 lines; these are no faults
"""
import pathlib
import re
import subprocess
import sys

import report

LONGEST_LINE = 100
USUAL_FILE = 400  # about: longer ones are listed, for one who asks whether each is one idea
LONGEST_FILE = 800
SOURCES = {".cpp", ".hpp", ".py", ".sh", ".cmake"}
NAMES = {"dev", "run", "CMakeLists.txt"}
# Written so that this file does not find itself.
UNFINISHED = re.compile(r"\b(" + "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X", "HA" + "CK"]) +
                        r")\b|not " + r"implemented")
# Formats whose own words may look like markers are named here: path -> reason.
EXCEPTIONS = {}


def tracked(root):
    """Files that git knows (also new ones that it does not ignore); all files without git."""
    try:
        names = subprocess.run(
            ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others",
             "--exclude-standard"], capture_output=True, check=True).stdout.decode().split("\0")
        return [root / name for name in names if name and (root / name).is_file()]
    except (OSError, subprocess.CalledProcessError):
        return [p for p in root.rglob("*") if p.is_file() and "build" not in p.parts]


def faults_of(path, text, has_header=False):
    lines = text.splitlines()
    if len(lines) > LONGEST_FILE:
        yield f"{path}: {len(lines)} lines (at most {LONGEST_FILE}): which idea wants its own file?"
    for number, line in enumerate(lines, 1):
        if len(line) > LONGEST_LINE and not line.lstrip().startswith("sluice_room("):
            yield f"{path}:{number}: {len(line)} characters (at most {LONGEST_LINE})"
        if "\t" in line:
            yield f"{path}:{number}: a tab"
        if line != line.rstrip():
            yield f"{path}:{number}: blanks at the end of the line"
        if UNFINISHED.search(line) and str(path) not in EXCEPTIONS:
            yield f"{path}:{number}: an unfinished marker: finish it, or refuse the case by name"
    told_by_header = has_header and path.suffix == ".cpp"
    if path.suffix in (".cpp", ".hpp") and not told_by_header and not text.startswith("//"):
        yield f"{path}:1: the head of a file says in one sentence what it is for"


def long_files(root):
    """Files that are longer than most: (lines, path), the longest first."""
    lengths = [(len(file.read_text(encoding="utf-8").splitlines()), file.relative_to(root))
               for file in tracked(root) if file.suffix in SOURCES]
    return sorted((n, path) for n, path in lengths if n > USUAL_FILE)[::-1]


def check(root):
    root = pathlib.Path(root)
    faults = []
    for file in sorted(tracked(root)):
        if file.suffix not in SOURCES and file.name not in NAMES:
            continue
        path = file.relative_to(root)
        try:
            text = file.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            faults.append(f"{path}: not UTF-8")
            continue
        faults += faults_of(path, text, has_header=file.with_suffix(".hpp").is_file())
    return faults


if __name__ == "__main__":
    if "--long" in sys.argv:
        for length, file in long_files(report.PROJECT):
            print(f"{length} {file}")
        sys.exit(0)
    report.main("lines", check)
