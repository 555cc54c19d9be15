#!/usr/bin/env python3
"""Write the tables of rooms in docs/developer_guide.md anew, from tools/lint/rooms.py.

A table stands between `<!-- rooms of src/FOLDER: written by ./dev docs -->` and
`<!-- end of rooms -->`.

    room_pages.py [PAGE]
"""
import pathlib
import re
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tools" / "lint"))
from rooms import ROOMS, path_of  # noqa: E402

PAGE = PROJECT / "docs" / "developer_guide.md"
BLOCK = re.compile(r"(<!-- rooms of src(?:/(?P<folder>[\w/]+))?: written by \./dev docs -->\n)"
                   r".*?(<!-- end of rooms -->)", re.DOTALL)


def table(folder):
    """The rooms of a folder, the lowest first, those inside a room behind it."""
    lines = ["| floor | folder | what it holds |", "| --- | --- | --- |"]

    def add(inside, floors_above):
        for number, floor in enumerate(ROOMS[inside]):
            for room, what in floor.items():
                path = path_of(inside, room)
                shown = path[len(folder):].lstrip("/")
                name = f"the files of `src/{path}` itself" if room == "." else f"`{shown}/`"
                lines.append(f"| {floors_above}{number} | {name} | {what} |")
                if folder and room != "." and path in ROOMS:
                    add(path, f"{floors_above}{number}.")

    add(folder, "")
    return "\n".join(lines) + "\n"


def renewed(text):
    """A page with its tables as they are to be."""
    return BLOCK.sub(lambda m: f"{m[1]}\n{table(m['folder'] or '')}\n{m[3]}", text)


def tables_of(text):
    """The folders of which a page has a table."""
    return [block["folder"] or "" for block in BLOCK.finditer(text)]


def main():
    page = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else PAGE
    page.write_text(renewed(page.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
