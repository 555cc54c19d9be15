#!/usr/bin/env python3
"""Compiler seconds by target, from the lines "USER SYSTEM WALL OBJECT" of timed_compiler.sh.

    compile_times.py FILE [FILE_BEFORE]
"""
import collections
import re
import sys

OBJECT = re.compile(r"([^/]+)\.dir/")


def seconds_by_target(lines):
    """{target: user seconds}; of an object that was compiled twice the last."""
    of_object = {}
    for line in lines:
        words = line.split()
        if len(words) == 4 and OBJECT.search(words[3]):
            of_object[words[3]] = float(words[0])
    seconds = collections.Counter()
    for name, user in of_object.items():
        seconds[OBJECT.search(name).group(1)] += user
    return seconds


def table(now, before):
    """One line a target, the dearest first, then the sums of program and tests."""
    rows = sorted(now.items(), key=lambda item: -item[1])
    for title, tests in (("program", False), ("tests", True)):
        def total(seconds):
            return sum(s for target, s in seconds.items() if target.endswith("_test") == tests)
        rows.append((title, total(now)))
        before = {**before, title: total(before)}
    return [f"{name:32}{now_s:9.1f}" + (f"{before[name]:9.1f}" if before.get(name) else "")
            for name, now_s in rows]


def main(files):
    if not 1 <= len(files) <= 2:
        sys.exit(__doc__)
    times = []
    for name in files:
        with open(name, encoding="utf-8") as lines:
            times.append(seconds_by_target(lines))
    print("\n".join(table(times[0], times[1] if len(times) == 2 else {})))


if __name__ == "__main__":
    main(sys.argv[1:])
