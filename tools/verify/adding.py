#!/usr/bin/env python3
"""Follow docs/adding.md in a copy of a checkout: all its edits, a build, all its commands.

    adding.py --root CHECKOUT --folder FOLDER [--apply-only | --sizes]

The copy is FOLDER/sluice. It is built without optimisation, because every example changes headers
that much includes; the decks of the page are small. Ends with a line RESULT for ./dev verify.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import time

import guide

PAGE = "docs/adding.md"
TARGETS = re.compile(r"^ninja -C build/release (.+)$")
LIMIT = 400  # seconds of a command; all bad decks, without optimisation, take 130 on two cores


def copied(root, folder):
    """The tracked files of a checkout as they are now, in a repository of their own."""
    to = folder / "sluice"
    shutil.rmtree(to, ignore_errors=True)
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, check=True)
    for name in filter(None, listed.stdout.decode().split("\0")):
        if (root / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, to / name)
    for words in (["init", "-q"], ["add", "-A"],
                  ["-c", "user.name=guide", "-c", "user.email=guide", "commit", "-qm", "before"]):
        subprocess.run(["git", *words], cwd=to, check=True)
    return to


def run(words, folder, limit=None, **more):
    """Exit status and output; 124 where it took too long."""
    try:
        done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=limit, check=False, **more)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return 124, f"not finished in {limit} s"


def build(commands, folder):
    """All targets that the page names, at once."""
    named = filter(None, (TARGETS.match(c.text) for c in commands))
    targets = sorted({target for match in named for target in match[1].split()})
    for words in (["cmake", "--preset", "release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1"],
                  ["ninja", "-C", "build/release", *targets]):
        status, told = run(words, folder)
        if status != 0:
            print("\n".join(told.splitlines()[-60:]))
            return False
    return True


def follow(commands, folder):
    """The commands that did not end as the page says."""
    failed = []
    for command in commands:
        if TARGETS.match(command.text):
            continue
        status, told = run(["bash", "-euo", "pipefail", "-c", command.text], folder, LIMIT)
        good = status == command.status
        print(f"{PAGE}:{command.line}: {'ok' if good else 'FAILED'}: {command.text}")
        if not good:
            print(f"  exit {status}, expected {command.status}")
            print("\n".join("  " + line for line in told.splitlines()[-40:]))
            failed.append(command)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", required=True, type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--apply-only", action="store_true", help="no build, no commands")
    parser.add_argument("--sizes", action="store_true", help="print what each section touches")
    given = parser.parse_args()
    edits, commands = guide.read((given.root / PAGE).read_text(encoding="utf-8"))
    if given.sizes:
        for section, (files, new, lines) in guide.sizes(edits).items():
            print(f"{section}: {files} files ({new} new), {lines} lines")
        return 0
    began = time.monotonic()
    folder = copied(given.root.resolve(), given.folder)
    guide.apply(edits, folder)
    print(f"{PAGE}: {len(edits)} edits made in {folder}")
    if given.apply_only:
        return 0
    if not build(commands, folder):
        print("RESULT: the examples of docs/adding.md do not compile")
        return 1
    failed = follow(commands, folder)
    print(f"RESULT: {len(guide.sizes(edits))} extensions of docs/adding.md made, "
          f"{len(commands) - len(failed)} of {len(commands)} commands as described, "
          f"{(time.monotonic() - began) / 60:.0f} min")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
