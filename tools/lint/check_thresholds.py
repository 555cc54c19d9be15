#!/usr/bin/env python3
"""Check that each named number of the fluid says what it is, and that docs/thresholds.md says it.

tools/docs/threshold_page.py says which comments `constexpr double` has in production code of
src/ice, one declaration for each. Further:
  the test of a threshold exists: Suite.Case in src/ or regression/, or the name of a file there;
    WITHOUT_TEST lists the thresholds that have none, and only they may say "none"
  a number is defined once: no two constants have the same name and the same value
  numbers written with an exponent (1e-12) stand nowhere else in the code, but for defaults of
    members, bounds of tags and texts

    check_thresholds.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re
import sys

import cpp_text
import report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import threshold_page  # noqa: E402
from threshold_page import HOUSE, PAGE, is_for_tests, sources  # noqa: E402

WITHOUT_TEST = pathlib.Path(__file__).with_name("without_test.txt")
CASE = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)")
EXPONENT = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)e[-+]?\d+(?![\w.])", re.IGNORECASE)
MEMBER = re.compile(r"^\s*(?:double|float)\s+[^(]*;\s*$")  # a default that the deck reference lists
BOUND = re.compile(r"\b(?:at_most|at_least|above|below)\([^()]*\)")


def listed(file=WITHOUT_TEST):
    """path: names of the thresholds that may be without a test."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def tests(root):
    """Every Suite.Case, and every name of a file, below src/ and regression/."""
    found = set()
    for folder in ["src", "regression"]:
        for file in (root / folder).rglob("*"):
            if file.is_file():
                found.add(file.name)
                if file.name.endswith("_test.cpp"):
                    text = file.read_text(encoding="utf-8")
                    found |= {f"{suite}.{case}" for suite, case in CASE.findall(text)}
    return found


def comment_faults(known, root, allowed):
    cases, without = tests(root), set()
    for one in known:
        where = f"{one.path}:{one.line}: {one.name}"
        if one.kind == "list":
            yield f"{where}: one declaration for each number, with its comment"
        elif not one.read():
            yield (f"{where}: its comment above is not '// threshold: MEANING; unit: UNIT; test: "
                   "TEST' or '// coefficient: MEANING; unit: UNIT'")
        elif one.test == "none":
            without.add(f"{one.path}: {one.name}")
            if f"{one.path}: {one.name}" not in allowed:
                yield f"{where}: a threshold needs a test (or a line in without_test.txt)"
        elif one.test and one.test not in cases:
            yield f"{where}: there is no test '{one.test}'"
    for line in sorted(allowed - without):
        yield f"tools/lint/without_test.txt: '{line}': no such threshold is without a test"


def double_faults(known):
    first = {}
    for one in known:
        other = first.setdefault((one.name, one.value), one)
        if other is not one:
            yield (f"{one.path}:{one.line}: {one.name} = {one.value} is defined in "
                   f"{other.path}:{other.line} too: once, in the lowest room that needs it")


def bare_faults(root):
    for file in sources(root / HOUSE):
        inside = file.relative_to(root / "src")
        if is_for_tests(inside):
            continue
        code = threshold_page.DECLARED.sub(lambda m: re.sub(r"[^\n]", " ", m[0]),
                                           cpp_text.blanked(file.read_text(encoding="utf-8")))
        for number, line in enumerate(code.splitlines(), 1):
            found = EXPONENT.search(BOUND.sub("", line))
            if found and not MEMBER.match(line):
                yield f"src/{inside.as_posix()}:{number}: {found[0]}: a number to be named"


def check(root, allowed=None):
    root = pathlib.Path(root)
    known = list(threshold_page.constants(root))
    faults = list(comment_faults(known, root, listed() if allowed is None else allowed))
    faults += double_faults(known)
    faults += bare_faults(root)
    page = root / PAGE
    if not page.is_file() or page.read_text(encoding="utf-8") != threshold_page.page(root):
        faults.append(f"{PAGE}: it is not what the comments of {HOUSE} say: ./dev docs")
    return faults


if __name__ == "__main__":
    report.main("thresholds", check)
