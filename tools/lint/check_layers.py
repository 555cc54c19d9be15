#!/usr/bin/env python3
"""Check the arrows between the rooms of src/: includes run downward only, and never in a circle.

A room may include itself, any room of a lower rank, and the rooms of its own rank named in
SIDEWAYS. Tests (*_test.cpp) may also use TEST_HELPERS.

    check_layers.py [SOURCE_FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re

import report

# Lowest rank first; the rooms of one line do not know each other.
RANKS = [
    ["framework/base"],
    ["framework/deck", "framework/geometry", "framework/grid"],
    ["framework/field", "framework/scene"],
    ["framework/task", "framework/archive", "framework/particle", "framework/solve"],
    ["framework/refine", "framework/analysis"],
    ["framework/run"],
    ["eos", "exact"],
    ["models"],
    ["ice", "mpm"],
    ["mpmice"],
    ["app"],
]
# Arrows inside one rank that are wanted: (from, to).
SIDEWAYS = {("framework/task", "framework/solve"), ("exact", "eos")}

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
RANK_OF = {room: rank for rank, rooms in enumerate(RANKS) for room in rooms}


def room_of(path):
    """The room of a path below src/ ('framework/grid/level.hpp'), or None."""
    parts = path.split("/")
    name = "/".join(parts[:2]) if parts[0] == "framework" else parts[0]
    return name if len(parts) > 1 else None


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


def check(source):
    source = pathlib.Path(source)
    faults, graph = [], {}
    for file in sorted(p for p in source.rglob("*") if p.suffix in (".cpp", ".hpp")):
        path = file.relative_to(source).as_posix()
        room = room_of(path)
        if room not in RANK_OF:
            faults.append(f"{path}: '{room}' is no room of the design; rooms are listed in "
                          "tools/lint/check_layers.py")
            continue
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
            if other == room or other not in RANK_OF:
                continue
            down = RANK_OF[other] < RANK_OF[room]
            if not down and (room, other) not in SIDEWAYS:
                faults.append(f"{where}: {room} may not include {other} ({target}): "
                              "arrows run downward only")
    faults += ["circle: " + " -> ".join(circle) for circle in file_circles(graph)]
    return faults


if __name__ == "__main__":
    report.main("layers", check, "src")
