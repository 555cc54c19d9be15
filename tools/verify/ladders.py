#!/usr/bin/env python3
"""Run the accuracy studies of one group in full; write docs/accuracy.md with tables and pictures.

Groups: fluid (explicit ICE), pressure (semi-implicit ICE), solids (MPM and MPMICE).
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys

GROUPS = ("fluid", "pressure", "solids")

HEAD = """# What accuracy costs in time

This page is written by `./dev verify ladders_fluid ladders_pressure ladders_solids`. It contains
every study of `regression/accuracy` in full length; each point is the median of up to {repeats}
runs on one core. The tables show the default setting; pictures and CSV files contain all
settings. `sluice accuracy NAME` repeats a study. The times were measured on a machine of two
cores with occasional other load, so that they can be compared only within a study. Errors are
measured against the exact solution of the variable where there is one, otherwise against a finer
run of the same deck.
"""


def read_study(path):
    """The study as a dictionary; lines of comment are dropped."""
    lines = path.read_text().splitlines()
    return json.loads("\n".join(line for line in lines if not line.strip().startswith("//")))


def group_of(path, study):
    """The group of a study: by its name and by the folder of its deck."""
    if path.stem.startswith("implicit_"):
        return "pressure"
    return "solids" if "/mpm" in study["deck"] else "fluid"


def duration(seconds):
    """A time for people, three digits."""
    for unit, factor in (("us", 1e-6), ("ms", 1e-3)):
        if seconds < 1000 * factor:
            return f"{seconds / factor:.3g} {unit}"
    return f"{seconds:.3g} s"


def section(name, study, rows):
    """Heading, table of the default setting, and picture of one study, lines of Markdown."""
    lines = [f"\n## {study['title']}\n\n",
             f"`sluice accuracy {name}`: {study.get('norm', 'l1')} error of "
             f"`{study['variable']}`.\n\n",
             "| cells | steps | error | order | time |\n", "| --- | --- | --- | --- | --- |\n"]
    for row in rows:
        if row["default"] != "1":
            continue
        cells = " x ".join(n for n in (row["nx"], row["ny"], row["nz"]) if n != "1")
        if row["status"] != "done":
            lines.append(f"| {cells} | {row['steps']} | {row['status']} | | |\n")
            continue
        order = f"{float(row['order']):.2f}" if row["order"] else ""
        lines.append(f"| {cells} | {row['steps']} | {float(row['error']):.3e} | {order} | "
                     f"{duration(float(row['seconds']))} |\n")
    lines.append(f"\n![error against time](accuracy/{name}.png) [CSV](accuracy/{name}.csv)\n")
    return lines


def write_page(root, repeats):
    """docs/accuracy.md from the CSV files in docs/accuracy."""
    lines = [HEAD.format(repeats=repeats)]
    for path in sorted((root / "regression/accuracy").glob("*.study")):
        table = root / "docs/accuracy" / f"{path.stem}.csv"
        if table.exists():
            with table.open(newline="") as file:
                lines += section(path.stem, read_study(path), list(csv.DictReader(file)))
    (root / "docs/accuracy.md").write_text("".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("--group", choices=GROUPS, required=True)
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    studies = [path for path in sorted((given.root / "regression/accuracy").glob("*.study"))
               if group_of(path, read_study(path)) == given.group]
    pages = given.root / "docs/accuracy"
    pages.mkdir(parents=True, exist_ok=True)
    failed, runs = [], 0
    for path in studies:
        folder = given.folder / path.stem
        ended = subprocess.run([given.sluice, "accuracy", str(path), "-o", str(folder),
                                "--repeat", str(given.repeat)],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               check=False)
        (given.folder / f"{path.stem}.txt").write_text(ended.stdout)
        done = sum(line.startswith("[") for line in ended.stdout.splitlines())
        runs += done
        if ended.returncode != 0:
            failed.append(path.stem)
        print(f"{path.stem}: {done} runs" + (", FAILED" if ended.returncode else ""), flush=True)
        for ending in ("csv", "png"):
            file = folder / f"{path.stem}.{ending}"
            if file.exists():
                shutil.copy(file, pages)
    write_page(given.root, given.repeat)
    print(f"RESULT: {len(studies)} studies, {runs} runs"
          + (f"; with failed runs: {', '.join(failed)}" if failed else ""))
    return 1 if failed or not studies else 0


if __name__ == "__main__":
    sys.exit(main())
