#!/usr/bin/env python3
"""Check that functions are declared in the room that defines them.

A function that is declared in a lower room and defined in a higher one lets lower code call upward,
and no include shows it. Compared are names with their namespaces and classes, and the types of
parameters. Tests and helpers of tests are not looked at.

    check_declarations.py [SOURCE_FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import collections
import pathlib

import cpp_text
import report
from check_layers import room_of, sources
from rooms import TEST_SUPPORT


def is_for_tests(file):
    return file.stem.endswith(("_test", "_fuzz", "_mock", "_test_support")) or \
        TEST_SUPPORT in file.parts


def check(source):
    source = pathlib.Path(source)
    declared, defined = collections.defaultdict(list), []
    for file in sources(source):
        if is_for_tests(file.relative_to(source)):
            continue
        path = file.relative_to(source).as_posix()
        for function in cpp_text.read(file.read_text(encoding="utf-8")).functions:
            if function.local:
                continue
            if not function.defined:
                declared[function.name, function.parameters].append((path, function.first))
            elif file.suffix == ".cpp":
                defined.append((path, function))
    faults = []
    for path, function in defined:
        for other, line in declared.get((function.name, function.parameters), []):
            if room_of(other) != room_of(path):
                faults.append(f"{other}:{line}: '{function.name}' is declared in "
                              f"{room_of(other)} and defined in {room_of(path)} "
                              f"({path}:{function.first}): declare it in a header of that room")
    return sorted(faults)


if __name__ == "__main__":
    report.main("declarations", check, "src")
