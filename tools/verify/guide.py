"""Reads a page that tells how to extend the program, and does what it says in a checkout.

A line in bold says where the block below it belongs; `./dev verify adding` follows docs/adding.md
by these lines:

    **New file `PATH`**                        the block is the file
    **In `PATH`, after `TEXT`**                the block follows the line that contains TEXT
    **In `PATH`, before `TEXT`**               the block precedes it
    **In `PATH`, in place of `TEXT`**          the block replaces it
    **In `PATH`, without the line `TEXT`**     the line goes; there is no block
    **In `PATH`, `OLD` becomes `NEW`**         that text changes; there is no block
    **At the end of `PATH`**                   the block is added

TEXT stands in one line of the file alone, OLD at one place. A block of the language `sh` holds
commands for the root of the checkout, one per line, run with `pipefail`: what stands behind a pipe
must read all of it. `# exit N` at the end of a line is the exit status that is expected, 0 where
there is none.
"""
import dataclasses
import re

FENCE = re.compile(r"^```(\w*)$")
BOLD = re.compile(r"^\*\*(?=New file `|In `|At the end of `)(.*)\*\*$")
PLACES = [  # what is done; where; whether a block follows
    ("new", re.compile(r"New file `(?P<path>[^`]+)`"), True),
    ("after", re.compile(r"In `(?P<path>[^`]+)`, after `(?P<text>[^`]+)`"), True),
    ("before", re.compile(r"In `(?P<path>[^`]+)`, before `(?P<text>[^`]+)`"), True),
    ("replace", re.compile(r"In `(?P<path>[^`]+)`, in place of `(?P<text>[^`]+)`"), True),
    ("remove", re.compile(r"In `(?P<path>[^`]+)`, without the line `(?P<text>[^`]+)`"), False),
    ("change", re.compile(r"In `(?P<path>[^`]+)`, `(?P<text>[^`]+)` becomes `(?P<to>[^`]+)`"),
     False),
    ("end", re.compile(r"At the end of `(?P<path>[^`]+)`"), True),
]
EXPECTED = re.compile(r"\s+# exit (\d+)$")


class GuideError(Exception):
    """A page that cannot be followed."""


@dataclasses.dataclass
class Edit:
    line: int  # of the page
    kind: str
    path: str
    text: str = ""  # by which the place is found
    to: str = ""  # the new text
    section: str = ""


@dataclasses.dataclass
class Command:
    line: int
    text: str
    status: int = 0
    section: str = ""


def place_of(line, number, section):
    """The edit that a bold line announces, and whether a block follows."""
    for kind, form, block in PLACES:
        found = form.fullmatch(line)
        if found:
            named = found.groupdict()
            return Edit(number, kind, named["path"], named.get("text", ""), named.get("to", ""),
                        section), block
    raise GuideError(f"line {number}: '{line}' is none of the forms of tools/verify/guide.py")


def read(page):
    """The edits and the commands of a page, each in its order."""
    edits, commands, waiting, section = [], [], None, ""
    lines = iter(enumerate(page.splitlines(), 1))
    for number, line in lines:
        fence, bold = FENCE.match(line), BOLD.match(line)
        if line.startswith("## "):
            section = line[3:].strip()
        placed = fence and fence[1] not in ("sh", "text")  # code, which belongs somewhere
        commanded = fence and fence[1] == "sh"
        if (waiting and line and (not fence or commanded)) or (placed and not waiting):
            raise GuideError(f"line {number}: a block and its place do not follow each other")
        if bold:
            edit, block = place_of(bold[1], number, section)
            edits.append(edit)
            waiting = edit if block else None
        elif fence:
            block = []
            for _, inside in lines:
                if inside == "```":
                    break
                block.append(inside)
            if waiting:
                waiting.to, waiting = "".join(f"{x}\n" for x in block), None
            elif fence[1] == "sh":
                for n, text in enumerate(block, number + 1):
                    expected = EXPECTED.search(text)
                    commands.append(Command(n, EXPECTED.sub("", text),
                                            int(expected[1]) if expected else 0, section))
    return edits, commands


def edited(edit, text):
    """The text of a file after an edit."""
    where = f"line {edit.line}: {edit.path}"
    if edit.kind == "end":
        return text + edit.to
    if edit.kind == "change":
        if text.count(edit.text) != 1:
            raise GuideError(f"{where} has {text.count(edit.text)} times '{edit.text}'")
        return text.replace(edit.text, edit.to)
    lines = text.splitlines(keepends=True)
    found = [n for n, line in enumerate(lines) if edit.text in line]
    if len(found) != 1:
        raise GuideError(f"{where} has {len(found)} lines with '{edit.text}'")
    at = found[0]
    parts = {"after": [lines[at], edit.to], "before": [edit.to, lines[at]], "replace": [edit.to],
             "remove": []}
    return "".join(lines[:at] + parts[edit.kind] + lines[at + 1:])


def apply(edits, root):
    """Makes the edits in a checkout."""
    for edit in edits:
        file = root / edit.path
        if edit.kind == "new":
            if file.exists():
                raise GuideError(f"line {edit.line}: {edit.path} exists already")
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(edit.to, encoding="utf-8")
        elif not file.is_file():
            raise GuideError(f"line {edit.line}: there is no file {edit.path}")
        else:
            file.write_text(edited(edit, file.read_text(encoding="utf-8")), encoding="utf-8")


def sizes(edits):
    """By section: files touched, new files, lines written."""
    table = {}
    for edit in edits:
        files, new, lines = table.setdefault(edit.section, (set(), set(), [0]))
        files.add(edit.path)
        if edit.kind == "new":
            new.add(edit.path)
        lines[0] += max(edit.to.count("\n"), 1)
    return {section: (len(files), len(new), lines[0])
            for section, (files, new, lines) in table.items()}
