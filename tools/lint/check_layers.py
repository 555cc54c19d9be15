#!/usr/bin/env python3
"""Check the arrows between the rooms of src/: includes run downward only, and never in a circle.

A room may include itself, any room of a lower rank, and the rooms of its own rank named in
SIDEWAYS. Inside framework, ice, mpm and mpmice each folder is a room, with a rank among those of
its house in FLOORS; files in no folder of their house are its top. Tests (*_test.cpp) and what
lies in test_support/ may use any room of their own house.

    check_layers.py [SOURCE_FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import pathlib
import re

import report

# Lowest rank first; the houses of one line do not know each other.
HOUSES = [["framework"], ["eos", "exact"], ["kinetics"], ["models"], ["ice", "mpm", "examples"],
          ["mpmice"], ["app"]]
# The rooms of a house, lowest first; the rooms of one line do not know each other.
FLOORS = {
    "framework": [
        ["base"],
        ["deck", "geometry", "grid"],
        ["field", "scene"],
        ["task", "archive", "particle", "solve"],
        ["refine", "analysis"],
        ["run"],
    ],
    "ice": [
        ["fluid"],
        ["conditions"],
        ["deck"],
        ["closure", "boundary"],
        ["step"],
        ["start", "sources", "transport", "tracers"],
        ["one_material", "classic"],
        ["mixture"],
        ["pressure", "walls"],
        ["scalars"],
        ["levels", "account"],
        ["saved"],
    ],
    "mpm": [
        ["material"],
        ["deck"],
        ["shape", "nodes"],
        ["boundary"],
        ["transfer", "loads"],
        ["contact"],
        ["start"],
        ["step"],
        ["grains"],
        ["levels", "account"],
        ["saved", "implicit"],
    ],
    "mpmice": [["deck", "geometry"], ["exchange"], ["burn"], ["step"], ["account"]],
}
# Houses whose files all lie in rooms.
NO_TOP = {"framework"}
# Arrows inside one rank that are wanted: (from, to).
SIDEWAYS = {("exact", "eos")}
TEST_SUPPORT = "test_support"

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')


def ranks():
    """Room -> (rank of its house, rank in it); the top of a house is above its floors."""
    found = {}
    for rank, houses in enumerate(HOUSES):
        for house in houses:
            floors = FLOORS.get(house, [])
            for floor, rooms in enumerate(floors):
                for room in rooms:
                    found[f"{house}/{room}"] = (rank, floor)
            if house not in NO_TOP:
                found[house] = (rank, len(floors))
            found[f"{house}/{TEST_SUPPORT}"] = (rank, len(floors))
    return found


RANK_OF = ranks()


def room_of(path):
    """The room of a path below src/ ('framework/grid/level.hpp'), or None."""
    parts = path.split("/")
    if len(parts) == 1:
        return None
    return "/".join(parts[:2]) if parts[0] in FLOORS and len(parts) > 2 else parts[0]


def allowed(room, other, for_tests):
    """May a file of `room` include one of `other`, both known rooms."""
    if room == other or (room, other) in SIDEWAYS:
        return True
    house, of_other = room.split("/")[0], other.split("/")[0]
    if other.endswith(TEST_SUPPORT) and not for_tests:
        return False
    if house == of_other:
        return for_tests or RANK_OF[other][1] < RANK_OF[room][1]
    return RANK_OF[other][0] < RANK_OF[room][0]


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
            if other in RANK_OF and not allowed(room, other, for_tests):
                faults.append(f"{where}: {room} may not include {other} ({target}): "
                              "arrows run downward only")
    faults += ["circle: " + " -> ".join(circle) for circle in file_circles(graph)]
    return faults


if __name__ == "__main__":
    report.main("layers", check, "src")
