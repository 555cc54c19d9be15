#!/usr/bin/env python3
"""Are the loops that `#pragma GCC ivdep` marks vectorised? As the compiler itself reports it.

Every source that holds such a loop, or includes a header that does, is compiled once more with the
flags of the build and -fopt-info-vec. A loop that no source turned into vectors is named with its
file and line: such loops are the kernels, and a change of what is inlined can undo them without a
word. Of a loop in a template or an inline function only some instances may be vectors; how many is
told, and is no fault: laws with exponentials have none.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

MARK = "#pragma GCC ivdep"
VECTORISED = re.compile(r"(\S+?):(\d+):\d+: optimized:\s+loop vectorized using (\d+) byte vectors")
MISSED = re.compile(r"(\S+?):(\d+):\d+: missed:\s+couldn't vectorize loop")
OBJECT = re.compile(r" -o (\S+)")


def marked_loops(sources):
    """(file, line of the `for`) of every marked loop."""
    loops = set()
    for source in sources:
        lines = source.read_text().splitlines()
        for number, line in enumerate(lines, 1):
            if line.strip() != MARK:
                continue
            while "for (" not in lines[number]:
                number += 1
            loops.add((str(source), number + 1))
    return loops


def included_by_object(build):
    """The files that each object of the build was compiled from, by the object's name."""
    told = subprocess.run(["ninja", "-C", str(build), "-t", "deps"], capture_output=True, text=True,
                          check=True).stdout
    files, of = {}, None
    for line in told.splitlines():
        if line and not line.startswith(" "):
            of = files.setdefault(line.split(":")[0], set())
        elif line.strip():
            of.add(os.path.normpath(build / line.strip()))
    return files


def commands_with(build, files):
    """The compile commands of sources that hold or include one of the files; no tests."""
    included = included_by_object(build)
    chosen = []
    for command in json.loads((build / "compile_commands.json").read_text()):
        name = pathlib.Path(command["file"]).name
        compiled = OBJECT.search(command["command"]).group(1)
        if name.endswith(("_fuzz.cpp", "_bench.cpp")) or "_test.dir/" in compiled:
            continue
        inputs = included.get(compiled, set())
        if files & (inputs | {command["file"]}):
            chosen.append(command)
    return chosen


def vectorised_loops(command):
    """{(file, line): bytes of the vectors of each instance, 0: none} as one source reports."""
    words = shlex.split(command["command"])
    if pathlib.Path(words[0]).name == "ccache":
        words = words[1:]
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report"
        words[words.index("-o") + 1] = "/dev/null"
        done = subprocess.run([*words, f"-fopt-info-vec-optimized-missed={report}", "-S"],
                              cwd=command["directory"], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{command['file']} does not compile:\n{done.stderr[-2000:]}")
        return loops_of(report.read_text() if report.exists() else "", command["directory"])


def loops_of(report, directory):
    loops = {}
    for line in report.splitlines():
        made = VECTORISED.match(line)
        if found := made or MISSED.match(line):
            place = (os.path.normpath(os.path.join(directory, found[1])), int(found[2]))
            width, before = int(found[3]) if made else 0, loops.setdefault(place, [])
            rest_of_one = before and before[-1] > width > 0  # narrower
            if not rest_of_one:
                before.append(width)
    return loops


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    given = parser.parse_args()
    root, build = given.root.resolve(), given.build.resolve()

    sources = [path for kind in ("cpp", "hpp") for path in (root / "src").rglob(f"*.{kind}")]
    loops = marked_loops(sources)
    commands = commands_with(build, {file for file, _ in loops})
    print(f"{len(loops)} marked loops; compiling {len(commands)} sources", flush=True)
    instances = {place: [] for place in loops}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, found in enumerate(pool.map(vectorised_loops, commands), 1):
            for place in loops & set(found):
                instances[place] += found[place]
            print(f"  {number} of {len(commands)}: {commands[number - 1]['file']}", flush=True)
    widths = {place: max(found, default=0) for place, found in instances.items()}
    missed = sorted(place for place in loops if widths[place] == 0)
    for file, line in missed:
        print(f"{os.path.relpath(file, root)}:{line}: marked, but nowhere turned into vectors")
    partly = sorted(place for place in loops if widths[place] > 0 and 0 in instances[place])
    for file, line in partly:
        found = instances[file, line]
        print(f"note: {os.path.relpath(file, root)}:{line}: {len(found) - found.count(0)} of "
              f"{len(found)} instances are vectors")
    widest = max(widths.values(), default=0)
    print(f"RESULT: {len(loops) - len(missed)} of {len(loops)} marked loops are vectors, "
          f"{sum(width == widest for width in widths.values())} of {widest} bytes; "
          f"{len(partly)} in some instances only")
    return 1 if missed or not loops else 0


if __name__ == "__main__":
    sys.exit(main())
