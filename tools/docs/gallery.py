#!/usr/bin/env python3
"""Draw the pictures of docs/gallery.md by the commands that stand before them.

    gallery.py [--sluice PROGRAM] [--all] [NAME...]     draws what is older than its deck (--all:
                                                        everything; NAME: these pictures)
    gallery.py --check                                  exit 1: names what is older

A block of the language `sh` in docs/gallery.md has lines `sluice run DECK ...` and at last lines
`sluice plot|movie ... -o NAME`; the picture goes to docs/pictures/NAME. What a picture was drawn
from, its commands and its decks (without comments and blanks), is recorded as a checksum in
docs/pictures/drawn.json: where that differs the picture is older than its deck.
"""
import argparse
import hashlib
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE, PICTURES, RECORD = "docs/gallery.md", "docs/pictures", "docs/pictures/drawn.json"
BLOCK = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


class GalleryError(Exception):
    """A block that cannot be followed."""


def commands_of(block):
    """Lines of a block; one that ends with a backslash goes on in the next."""
    return [line.strip() for line in block.replace("\\\n", " ").splitlines() if line.strip()]


def output_of(command):
    """The file that a command draws, or None for one that runs a deck."""
    words = shlex.split(command)
    if words[:2] not in (["sluice", "run"], ["sluice", "plot"], ["sluice", "movie"]):
        raise GalleryError(f"{PAGE}: '{command}': a command is sluice run, plot or movie")
    if words[1] == "run":
        return None
    if "-o" not in words[:-1]:
        raise GalleryError(f"{PAGE}: '{command}' names no picture (-o)")
    return words[words.index("-o") + 1]


def blocks(root):
    """[(commands, names of the pictures)] of the page."""
    found = []
    for block in BLOCK.findall((root / PAGE).read_text(encoding="utf-8")):
        commands = commands_of(block)
        found.append((commands, [name for name in map(output_of, commands) if name]))
    return found


def decks_of(command):
    """The decks that a command names, relative to the root."""
    return [word for word in shlex.split(command) if word.endswith(".ups")]


def checksum(root, commands, picture):
    """Of what decides how a picture looks: the runs and its own command, and their decks."""
    digest = hashlib.sha256()
    for command in commands:
        if output_of(command) not in (None, picture):
            continue
        digest.update(" ".join(shlex.split(command)).encode() + b"\n")
        for deck in decks_of(command):
            path = root / deck
            if not path.is_file():
                raise GalleryError(f"{PAGE}: there is no deck {deck}")
            text = COMMENT.sub("", path.read_text(encoding="utf-8"))
            digest.update("".join(text.split()).encode() + b"\n")
    return digest.hexdigest()[:16]


def recorded(root):
    path = root / RECORD
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def faults(root):
    """What a test tells: pictures that are older than their decks, lost, or not in the page."""
    known, page = recorded(root), (root / PAGE).read_text(encoding="utf-8")
    for commands, pictures in blocks(root):
        for picture in pictures:
            current = checksum(root, commands, picture)
            if not (root / PICTURES / picture).is_file():
                yield f"{PAGE}: {PICTURES}/{picture} is not there: ./dev docs draws it"
            elif known.get(picture) != current:
                yield f"{PAGE}: {picture} is older than its deck or commands: ./dev docs draws it"
            if f"(pictures/{picture})" not in page:
                yield f"{PAGE}: {picture} is drawn but not shown"


def run(command, sluice, folder, root):
    words = shlex.split(command)
    words = [sluice, *(str(root / word) if word.endswith(".ups") else word for word in words[1:])]
    if words[1] == "run":
        words += ["--progress", "none", "--quiet"]
    ended = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise GalleryError(f"'{command}' ended with {ended.returncode}:\n{ended.stdout[-1000:]}"
                           f"{ended.stderr[-2000:]}")


def draw(root, sluice, wanted):
    """Draws the pictures of which wanted(name, checksum) says so; their number."""
    drawn = 0
    for commands, pictures in blocks(root):
        sums = {picture: checksum(root, commands, picture) for picture in pictures}
        old = [picture for picture in pictures if wanted(picture, sums[picture])]
        if not old:
            continue
        with tempfile.TemporaryDirectory() as folder:
            for command in commands:
                if output_of(command) is None or output_of(command) in old:
                    print(command, flush=True)
                    run(command, sluice, folder, root)
            known = recorded(root)  # again: others may draw at the same time
            for picture in old:
                shutil.copyfile(pathlib.Path(folder) / picture, root / PICTURES / picture)
                known[picture] = sums[picture]
                drawn += 1
        text = json.dumps(dict(sorted(known.items())), indent=1) + "\n"
        (root / RECORD).write_text(text, encoding="utf-8")
    return drawn


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sluice", default=str(ROOT / "build/release/bin/sluice"))
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*")
    given = parser.parse_args()
    try:
        if given.check:
            found = list(faults(ROOT))
            print("\n".join(found))
            return 1 if found else 0
        known = recorded(ROOT)

        def wanted(name, checksum_now):
            if given.names:
                return name in given.names
            there = (ROOT / PICTURES / name).is_file()
            return given.all or not there or known.get(name) != checksum_now
        sluice = str(pathlib.Path(given.sluice).resolve())
        print(f"{draw(ROOT, sluice, wanted)} pictures drawn")
    except GalleryError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
