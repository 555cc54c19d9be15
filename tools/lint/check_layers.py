#!/usr/bin/env python3
"""Check the arrows between the rooms of src/: includes run downward only, and never in a circle.

rooms.py has the rooms and their order, also inside rooms. Tests (*_test.cpp) and what lies in
test_support/ may use any room of their own house (the first folder of a path), and they alone may
use test_support/. Every folder with sources is a room, and every room of rooms.py is a folder with
sources.

    check_layers.py [SOURCE_FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re

import report
from rooms import ROOMS, TEST_SUPPORT, all_rooms, floor_of, path_of

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')


def sources(source):
    return sorted(p for p in source.rglob("*") if p.suffix in (".cpp", ".hpp"))


def room_of(path):
    """The innermost room of a path below src/ ('ice/step/runs.hpp': 'ice/step'); None: no room.

    Helpers of tests are in the room of their folder test_support/.
    """
    folders = path.split("/")[:-1]
    if TEST_SUPPORT in folders:
        folders = folders[:folders.index(TEST_SUPPORT)]
        return "/".join(folders + [TEST_SUPPORT]) if is_room(folders) else None
    return "/".join(folders) if is_room(folders, with_files=True) else None


def is_room(folders, with_files=False):
    """Whether a path of folders leads through rooms, and to one that may hold files."""
    folder = ""
    for name in folders:
        if folder not in ROOMS or floor_of(folder, name) is None:
            return False
        folder = path_of(folder, name)
    return bool(folder) and (not with_files or folder not in ROOMS or
                             floor_of(folder, ".") is not None)


def is_below(other, room):
    """Whether `other` is on a lower floor than `room`, where their paths part."""
    of_room, of_other = room.split("/") + ["."], other.split("/") + ["."]
    folder = ""
    while of_room[0] == of_other[0]:
        folder = path_of(folder, of_room.pop(0))
        of_other.pop(0)
    return floor_of(folder, of_other[0]) < floor_of(folder, of_room[0])


def allowed(room, other, for_tests):
    """May a file of `room` include one of `other`, both known rooms."""
    if room == other:
        return True
    if other.endswith(TEST_SUPPORT) and not for_tests:
        return False
    house, of_other = room.split("/")[0], other.split("/")[0]
    if house == of_other:
        return for_tests or is_below(other, room)
    return is_below(of_other, house)


def includes(file):
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def file_circles(graph):
    """Circles of headers, each once, as lists of paths."""
    found, state = [], {}

    def visit(node, trail):
        state[node] = "open"
        trail.append(node)
        for target in sorted(graph.get(node, ())):
            if state.get(target) == "open":
                found.append(trail[trail.index(target):] + [target])
            elif target not in state:
                visit(target, trail)
        trail.pop()
        state[node] = "done"

    for node in sorted(graph):
        if node not in state:
            visit(node, [])
    return found


def check_arrows(source):
    source = pathlib.Path(source)
    faults, graph = [], {}
    for file in sources(source):
        path = file.relative_to(source).as_posix()
        room = room_of(path)
        if room is None:
            faults.append(f"{path}: '{path.rpartition('/')[0]}' is no room of the design; rooms "
                          "are listed in tools/lint/rooms.py")
            continue
        for_tests = file.name.endswith("_test.cpp") or room.endswith(TEST_SUPPORT)
        for number, target in includes(file):
            where = f"{path}:{number}"
            if not (source / target).is_file():
                if "/" in target:
                    faults.append(f'{where}: "{target}" is not a file below src/')
                elif (file.parent / target).is_file():
                    faults.append(f'{where}: write "{file.parent.relative_to(source)}/{target}": '
                                  "includes are given from src/")
                continue  # else a generated header
            graph.setdefault(path, set()).add(target)
            other = room_of(target)
            if other is not None and not allowed(room, other, for_tests):
                faults.append(f"{where}: {room} may not include {other} ({target}): "
                              "arrows run downward only")
    faults += ["circle: " + " -> ".join(circle) for circle in file_circles(graph)]
    return faults


def check_rooms(source):
    """Rooms that are listed and do not exist."""
    source = pathlib.Path(source)
    filled = {room_of(p.relative_to(source).as_posix()) for p in sources(source)}
    for folder, _, room, _ in all_rooms():
        path = path_of(folder, room)
        if (room == "." or path not in ROOMS) and path not in filled:
            what = "no sources of its own" if room == "." else "no such folder of sources"
            yield f"rooms.py: '{path}': {what}"


def check(source):
    return check_arrows(source) + list(check_rooms(source))


if __name__ == "__main__":
    report.main("layers", check, "src")
