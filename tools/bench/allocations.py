#!/usr/bin/env python3
"""Count the allocations of a step: the difference of two runs with different numbers of steps.

    allocations.py DECK                  in steps 11 to 20
    allocations.py DECK --steps 5 10     in steps 6 to 10
    allocations.py DECK -- --set A=B     what follows -- goes to sluice run

Prints allocations a step, all and those of --large bytes or more (131072), with their bytes.
Nothing is written by the runs. Steps that relocate particles between boxes or regrid count as all
others: choose steps without. One rank, one thread.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCE = pathlib.Path(__file__).with_suffix(".cpp")
LARGE = 131072


def build_library(folder):
    library = pathlib.Path(folder) / "allocations.so"
    subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-O2", "-shared", "-fPIC",
                    str(SOURCE), "-o", str(library)], check=True)
    return library


def counts_of(command, library, folder, large=LARGE):
    """All, their bytes, large ones, their bytes: of a whole process."""
    told = pathlib.Path(folder) / "counts"
    told.unlink(missing_ok=True)
    done = subprocess.run(command, capture_output=True, text=True,
                          env=dict(os.environ, LD_PRELOAD=str(library), ALLOCATIONS_FILE=str(told),
                                   ALLOCATIONS_LARGE=str(large)))
    if done.returncode != 0 or not told.is_file():
        sys.exit(f"allocations: {' '.join(command)} failed ({done.returncode}):\n"
                 + done.stderr[-2000:])
    return [int(word) for word in told.read_text().split()]


def by_step(few, many, steps):
    return [(b - a) / steps for a, b in zip(few, many)]


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("deck")
    parser.add_argument("--steps", type=int, nargs=2, default=(10, 20), metavar=("FEW", "MANY"))
    parser.add_argument("--large", type=int, default=LARGE, help="bytes of a large one")
    parser.add_argument("--sluice", default=str(ROOT / "build/release/bin/sluice"))
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    given = parser.parse_args(words[:end])
    given.options = words[end + 1:]
    return given


def main():
    given = parse()
    few, many = given.steps
    if not 0 < few < many:
        sys.exit(f"allocations: --steps {few} {many}: the second number must be the larger one")
    with tempfile.TemporaryDirectory() as folder:
        library, counts = build_library(folder), []
        for steps in (few, many):
            command = [given.sluice, "run", given.deck, "--no-output", "--progress", "none",
                       "--threads", "1", "--max-steps", str(steps), *given.options]
            counts.append(counts_of(command, library, folder, given.large))
    number, size, large, large_size = by_step(*counts, many - few)
    print(f"{number:.0f} allocations a step, {size / 1e6:.2f} MB; "
          f"{large:.1f} of {given.large} bytes or more, {large_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
