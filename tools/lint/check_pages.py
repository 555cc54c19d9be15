#!/usr/bin/env python3
"""Check what pages say of the sources: tables of rooms, names of files and of functions.

docs/developer_guide.md has the tables that tools/docs/room_pages.py writes, one of each folder of
rooms that is not inside another. In pages below docs/ and at the root, what stands in `code` and
looks like a file of ours (src/ice/ice.hpp, `runs.hpp`), or like a function or member of a class of
ours (`Class::function`), exists. So does each folder below src/ that is named there.

    check_pages.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re
import sys

import cpp_text
import report
from check_lines import tracked
from names import Names
from rooms import ROOMS

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import room_pages  # noqa: E402

GUIDE = "docs/developer_guide.md"
BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`([^`]+)`")
FOLDER = re.compile(r"(?<![\w./-])(src(?:/\w+)*)/?(?![\w./*])")
MEMBER = re.compile(r"(?<![\w:])((?:[A-Za-z]\w*::)+~?\w+)")
CALL = re.compile(r"(?<![\w:.>])([a-z]\w*)\(\)")
PATTERN = re.compile(r"\b[A-Z]{4,}\b")  # sluice::ROOM::FILE
# Pages that tell of the past, or of a checkout that a reader makes: their names need not exist.
OTHER_TIMES = {"CHANGELOG.md", "docs/your_own_component.md"}
# Namespaces of others.
FOREIGN = {"std", "fmt", "gnu", "testing", "nlohmann", "Eigen", "MPI"}
NEW_FILE = re.compile(r"^\*\*New file `([^`]+)`\*\*$", re.MULTILINE)


def check_rooms(root):
    page = root / GUIDE
    if not page.is_file():
        return
    text = page.read_text(encoding="utf-8")
    if room_pages.renewed(text) != text:
        yield f"{GUIDE}: its tables of rooms are not those of tools/lint/rooms.py: ./dev docs"
    for folder in {""} | {folder.split("/")[0] for folder in ROOMS if folder}:
        if folder not in room_pages.tables_of(text):
            yield f"{GUIDE}: there is no table of the rooms of src/{folder}"


def members(root):
    """Functions, types, members and enumerators of the sources, by each end of their names."""
    found = set()
    for file in (root / "src").rglob("*"):
        if file.suffix in (".cpp", ".hpp"):
            read = cpp_text.read(file.read_text(encoding="utf-8"))
            for name in [*(f.name for f in read.functions), *(t.name for t in read.types),
                         *cpp_text.fields(read)]:
                parts = name.split("::")
                found |= {"::".join(parts[n:]) for n in range(len(parts))}
    return found


def check_names(root):
    names = Names(root)
    known = members(root)
    for page in sorted(f for f in tracked(root) if f.suffix == ".md"):
        path = page.relative_to(root).as_posix()
        if path in OTHER_TIMES:
            continue
        text = BLOCK.sub(lambda block: re.sub(r"[^\n]", " ", block[0]),
                         page.read_text(encoding="utf-8"))
        made = set(NEW_FILE.findall(text))
        for span in SPAN.finditer(text):
            where = f"{path}:{text.count(chr(10), 0, span.start()) + 1}"
            if span[1] in made:
                if names.has(span[1]):
                    yield f"{where}: '{span[1]}' is to be a new file, and exists"
                continue
            for _, fault in names.faults(span[1]):
                yield f"{where}: {fault}"
            for folder in FOLDER.finditer(span[1]):
                if not (root / folder[1]).is_dir() and not names.has(folder[1] + ".cpp") and \
                        not names.has(folder[1] + ".hpp"):
                    yield f"{where}: there is no folder or file '{folder[1]}'"
            for name in [*MEMBER.findall(span[1]), *CALL.findall(span[1])]:
                ours = name.split("::")[0] not in FOREIGN and not PATTERN.search(name)
                if ours and name not in known:
                    yield f"{where}: there is no '{name}' in src/"


def check(root):
    root = pathlib.Path(root)
    return list(check_rooms(root)) + list(check_names(root))


if __name__ == "__main__":
    report.main("pages", check)
