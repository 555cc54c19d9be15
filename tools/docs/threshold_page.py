#!/usr/bin/env python3
"""Write docs/thresholds.md, the thresholds and coefficients of the fluid, from src/ice.

Every `constexpr double` of production code below src/ice has a comment right above it, of one of
the forms

    // threshold: MEANING; unit: UNIT; test: TEST
    // coefficient: MEANING; unit: UNIT

with lines that go on after `//   `. A threshold is where the code begins to do something else, or
a bound: another value would do, and TEST (Suite.Case, or the file of a table of cases) covers the
case that it is there for; "none" where no test does. A coefficient is a number of a formula, or a
mark. A constant made of other constants alone has no number of its own and no comment.

    threshold_page.py
"""
import dataclasses
import pathlib
import re
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tools" / "lint"))
import cpp_text  # noqa: E402
from check_declarations import is_for_tests  # noqa: E402
from check_layers import sources  # noqa: E402
from rooms import all_rooms, path_of  # noqa: E402

PAGE = "docs/thresholds.md"
HOUSE = "src/ice"
DECLARED = re.compile(r"\bconstexpr\s+double\s+([^;]*);")
NAMED = re.compile(r"^(\w+)(?:\[\w*\])?\s*=\s*(.+)$", re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])(0x[\da-f.]+p[-+]?\d+|\d+\.?\d*(?:e[-+]?\d+)?)(?![\w.])",
                    re.IGNORECASE)
FORM = re.compile(r"^(threshold|coefficient): (.+?); unit: ([^;]+?)(?:; test: ([^;]+?))?$")
HEAD = """# Thresholds of the fluid

This page is written by `./dev docs` from the comments of `src/ice`. A threshold is where the code
begins to do something else, or a bound: another value would do. Its test is the one that covers
the case for which the threshold is there, or the file of a table of cases; with *none* no test
does. A coefficient is a number of a formula, or a mark. A unit of 1 stands for a pure number; the
meaning says what it is relative to.
"""


@dataclasses.dataclass
class Constant:
    path: str
    line: int
    name: str
    value: str
    said: str = ""
    kind: str = ""
    meaning: str = ""
    unit: str = ""
    test: str = ""

    def read(self):
        """Whether the comment above has one of the two forms; takes what it says."""
        form = FORM.match(self.said)
        if not form or (form[1] == "threshold") != (form[4] is not None):
            return False
        self.kind, self.meaning, self.unit, self.test = form[1], form[2], form[3], form[4] or ""
        return True


def has_own_number(value):
    """Whether a value is more than other constants, and 0 and 1 with them."""
    if not re.search(r"[A-Za-z_]", NUMBER.sub("", value)):
        return True
    return any(number not in ("0", "1", "0.0", "1.0") for number in NUMBER.findall(value))


def comment_above(lines, line):
    """The end of the comment right above a line (from 1), from the line that begins a form."""
    words, at = [], line - 2
    while at >= 0 and lines[at].lstrip().startswith("//"):
        words.insert(0, re.sub(r"^\s*//\s*", "", lines[at]))
        if re.match(r"(threshold|coefficient):", words[0]):
            break
        at -= 1
    return " ".join(words)


def constants_of(path, text):
    """Every constant of a file that has a number of its own; of a list of several, all."""
    lines = text.splitlines()
    for found in DECLARED.finditer(cpp_text.blanked(text)):
        line = text.count("\n", 0, found.start()) + 1
        said = comment_above(lines, line)
        parts = [found[1]] if "{" in found[1] else re.split(r",(?![^(]*\))", found[1])
        for part in parts:
            named = NAMED.match(part.strip())
            if named and has_own_number(named[2]):
                one = Constant(path, line, named[1], " ".join(named[2].split()), said)
                one.kind = "list" if len(parts) > 1 else ""
                yield one


def constants(root):
    root = pathlib.Path(root)
    for file in sources(root / HOUSE):
        inside = file.relative_to(root / "src")
        if not is_for_tests(inside):
            path = f"src/{inside.as_posix()}"
            yield from constants_of(path, file.read_text(encoding="utf-8"))


def table(kind, rows):
    columns = ["name", "value", "unit", "meaning"] + ["test"] * (kind == "threshold") + ["file"]
    lines = ["| " + " | ".join(columns) + " |", "| " + " | ".join("---" for _ in columns) + " |"]
    for one in rows:
        test = [one.test if one.test == "none" else f"`{one.test}`"] if kind == "threshold" else []
        file = pathlib.PurePosixPath(one.path).name
        cells = [f"`{one.name}`", f"`{one.value}`", one.unit, one.meaning, *test,
                 f"[{file}](../{one.path})"]
        lines.append("| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def page(root):
    """The page; constants without a comment of the right form are left to the lint."""
    known = [one for one in constants(root) if one.kind != "list" and one.read()]
    text = HEAD
    rooms = [path_of(folder, room) for folder, _, room, _ in all_rooms() if folder == "ice"]
    for room in dict.fromkeys(rooms):
        here = [one for one in known if pathlib.PurePosixPath(one.path).parent.as_posix()
                == f"src/{room}"]
        for kind, heading in [("threshold", room), ("coefficient", f"Coefficients of {room}")]:
            rows = [one for one in here if one.kind == kind]
            if rows:
                mark = "##" if kind == "threshold" or len(rows) == len(here) else "###"
                text += f"\n{mark} {heading}\n\n{table(kind, rows)}"
    return text


def main():
    (PROJECT / PAGE).write_text(page(PROJECT), encoding="utf-8")


if __name__ == "__main__":
    main()
