#!/usr/bin/env python3
"""Check that functions fit a screen, and that folders can be taken in at a glance.

A function of production code has at most 60 lines, from the first of its head to its closing
brace. A table, rows of data, may be longer: the comment above it says so ("Table: a row for each
model."). A folder of src/ holds at most 45 files of production code; tests, fuzz targets, helpers
of tests do not count.

    check_functions.py [SOURCE_FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import collections
import pathlib
import re

import cpp_text
import report
from check_declarations import is_for_tests
from check_layers import sources

LONGEST_FUNCTION = 60
MOST_FILES = 45
TABLE = re.compile(r"//.*\bTable: ")


def is_table(lines, first):
    """Whether the comment right above line `first` (from 1) calls what follows a table."""
    above = first - 1
    while above > 0 and lines[above - 1].lstrip().startswith("//"):
        above -= 1
    return bool(TABLE.search("\n".join(lines[above:first - 1])))


def faults_of(path, text):
    lines = text.splitlines()
    for function in cpp_text.read(text).functions:
        length = function.last - function.first + 1
        if function.defined and length > LONGEST_FUNCTION and not is_table(lines, function.first):
            yield (f"{path}:{function.first}: {function.name}: {length} lines (at most "
                   f"{LONGEST_FUNCTION}; a table says so above: // Table: ...)")


def check(source):
    source = pathlib.Path(source)
    faults, counts = [], collections.Counter()
    for file in sources(source):
        inside = file.relative_to(source)
        if is_for_tests(inside):
            continue
        counts[inside.parent.as_posix()] += 1
        faults += faults_of(f"src/{inside.as_posix()}", file.read_text(encoding="utf-8"))
    faults += [f"src/{folder}/: {count} files of production code (at most {MOST_FILES}): "
               "which subjects want rooms of their own?"
               for folder, count in sorted(counts.items()) if count > MOST_FILES]
    return faults


if __name__ == "__main__":
    report.main("functions", check, "src")
