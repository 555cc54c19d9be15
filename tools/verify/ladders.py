#!/usr/bin/env python3
"""Run accuracy studies in full; write docs/accuracy.md with tables and pictures.

--group runs the studies of some components; --only NAME those of these names; --page writes the
page from what docs/accuracy has, without a run; --pictures draws the pictures again from it.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

from accuracy_page import draw_pictures, studies_of, write_page

GROUPS = {"fluid": ("fluid", "levels", "reactions"), "pressure": ("pressure",),
          "solids": ("solids", "implicit", "coupled")}


def run(given, name, pages):
    """One study; how many runs it did, and whether all of them were good."""
    folder = given.folder / name
    ended = subprocess.run([given.sluice, "accuracy",
                            str(given.root / "regression/accuracy" / f"{name}.study"),
                            "-o", str(folder), "--repeat", str(given.repeat)],
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           check=False)
    given.folder.mkdir(parents=True, exist_ok=True)
    (given.folder / f"{name}.txt").write_text(ended.stdout)
    for ending in ("csv", "png"):
        file = folder / f"{name}.{ending}"
        if file.exists():
            shutil.copy(file, pages)
    return sum(line.startswith("[") for line in ended.stdout.splitlines()), ended.returncode == 0


def chosen(given):
    """The names of the studies that are asked for."""
    studies = studies_of(given.root)
    if given.only:
        return [name for name in studies if name in given.only]
    if given.group:
        return [n for n, s in studies.items() if s["component"] in GROUPS[given.group]]
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--sluice")
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--group", choices=GROUPS)
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    names = chosen(given)
    if not names and not given.page and not given.pictures:
        parser.error("nothing is asked for: --group, --only, --page or --pictures")
    pages = given.root / "docs/accuracy"
    pages.mkdir(parents=True, exist_ok=True)
    failed, runs = [], 0
    for name in names:
        done, good = run(given, name, pages)
        runs += done
        if not good:
            failed.append(name)
        print(f"{name}: {done} runs" + ("" if good else ", FAILED"), flush=True)
    if given.pictures:
        draw_pictures(given.root)
    write_page(given.root, given.repeat)
    if names:
        print(f"RESULT: {len(names)} studies, {runs} runs"
              + (f"; with failed runs: {', '.join(failed)}" if failed else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
