#!/usr/bin/env python3
"""The names that users and files know: what a renaming of symbols must not change.

    known_names.py --sluice PROGRAM [--check FILE | --write FILE]

The list has a line for each tag and attribute of a deck, each label, option, effect, task, JSON
key, field of an archive, study, case and benchmark. --check exits with 1 where a line of FILE is
gone; lines that are new are printed, and belong into FILE.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = ["accuracy", "run", "check", "compare", "convert", "drive", "export", "extract",
            "help", "info", "movie", "new", "norms", "plan", "plot", "regress", "report", "tune"]
# Cases whose archives are looked at: a fluid, several materials, solids, both with burning.
RUNS = ["sod", "exchange", "blocks_gimp", "strand"]


def output_of(*command, folder=None):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, cwd=folder, check=False)
    return done.stdout


def golden_cases():
    file = PROJECT / "regression/golden/cases.json"
    text = re.sub(r"^\s*//.*$", "", file.read_text(encoding="utf-8"), flags=re.M)
    return json.loads(text)["cases"]


def keys_of(value, path=""):
    """Paths of the keys of a JSON value; names that a deck gives are left out by their depth."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield f"{path}/{key}"
            yield from keys_of(inner, f"{path}/{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from keys_of(inner, path + "[]")


def reference_lines(program):
    with tempfile.TemporaryDirectory() as folder:
        output_of(program, "help", "--markdown", folder)
        for page in sorted(pathlib.Path(folder, "deck").glob("*.md")):
            yield from page.read_text(encoding="utf-8").splitlines()


def tags(program):
    section = ""
    for line in reference_lines(program):
        if line.startswith(("## ", "### ")):  # those below are tables of laws of the section
            section = line.lstrip("# ").strip()
            yield f"tag {section}"
        match = re.match(r"\| ([@\w.]+) \|", line)
        if match:
            yield f"tag {section} {match[1]}"


def labels(program):
    for line in output_of(program, "help", "--labels").splitlines():
        match = re.match(r"\| (\S+) \| (\S+) \| (\S+) \|", line)
        if match and match[1] not in ("label", "---"):
            yield f"label {match[1]} {match[2]} {match[3]}"


def options(program):
    for command in COMMANDS:
        for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", output_of(program, command, "--help")):
            yield f"option {command} {option}"
    # The public suite's tools are links beside the program.
    for link in sorted(pathlib.Path(program).resolve().parent.iterdir()):
        if link.is_symlink() and link.resolve() == pathlib.Path(program).resolve():
            done = subprocess.run([str(link), "-h"], capture_output=True, text=True, check=False)
            for names in re.findall(r"^  (-[\w -]+?)(?:  | <)", done.stdout + done.stderr,
                                    flags=re.M):
                yield from (f"option {link.name} {name}" for name in names.split())


def plans(program):
    """Keys, effects and tasks of the plans of all golden cases."""
    for case in golden_cases():
        deck = PROJECT / "regression/golden" / case["deck"]
        sets = [argument for s in case.get("set", []) for argument in ("--set", s)]
        text = output_of(program, "plan", deck, "--json", "--quiet", *sets)
        if not text:
            yield f"plan of {case['name']} fails"
            continue
        plan = json.loads(text)
        yield from (f"plan {key}" for key in keys_of(plan))
        for effect in plan.get("effects", []):
            yield f"effect {effect['name']}"
        with tempfile.TemporaryDirectory() as folder:
            dot = pathlib.Path(folder) / "graph.dot"
            output_of(program, "plan", deck, "--graph", dot, "--quiet", *sets)
            if dot.is_file():
                for task in re.findall(r'"([^"]+)" \[shape=box', dot.read_text(encoding="utf-8")):
                    yield f"task {task}"


def archives(program):
    for case in golden_cases():
        if case["name"] not in RUNS:
            continue
        deck = PROJECT / "regression/golden" / case["deck"]
        sets = [argument for s in case.get("set", []) for argument in ("--set", s)]
        with tempfile.TemporaryDirectory() as folder:
            output_of(program, "run", deck, "-o", folder, "--set", "Time/max_Timesteps=3", *sets)
            for archive in sorted(pathlib.Path(folder).glob("*.uda.*")):
                if archive.is_symlink() or not archive.is_dir():
                    continue
                yield from (f"run.json {key}" for key in
                            keys_of(json.loads((archive / "run.json").read_text())))
                yield from (f"info {key}" for key in
                            keys_of(json.loads(output_of(program, "info", archive, "--json"))))
                for index in archive.rglob("*.xml"):
                    text = index.read_text(encoding="utf-8", errors="replace")
                    if index.name in ("input.xml",):
                        continue
                    yield from (f"archive <{tag}>" for tag in re.findall(r"<(\w+)", text))
                    yield from (f"archive @{a}" for a in re.findall(r'\s(\w+)="', text))


def files():
    for case in golden_cases():
        yield f"case {case['name']}"
    for study in (PROJECT / "regression/accuracy").glob("*.study"):
        yield f"study {study.stem}"
    for page in [PROJECT / "README.md", *(PROJECT / "docs").rglob("*.md")]:
        text = page.read_text(encoding="utf-8")
        where = page.relative_to(PROJECT)
        for heading in re.findall(r"^#+ (.+)$", text, flags=re.M):
            anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
            yield f"anchor {where}#{anchor}"
        yield from (f"anchor {where}#{a}" for a in re.findall(r'<a id="([^"]+)"', text))


def all_names(program):
    found = set(files())
    for part in (tags, labels, options, plans, archives):
        found.update(part(program))
    return sorted(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--check")
    parser.add_argument("--write")
    arguments = parser.parse_args()
    names = all_names(arguments.sluice)
    if arguments.write:
        pathlib.Path(arguments.write).write_text("\n".join(names) + "\n", encoding="utf-8")
    if not arguments.check:
        return 0
    known = set(pathlib.Path(arguments.check).read_text(encoding="utf-8").split("\n")) - {""}
    gone, new = sorted(known - set(names)), sorted(set(names) - known)
    print("\n".join([f"gone: {name}" for name in gone] + [f"new: {name}" for name in new]))
    print(f"names: {len(names)}, {len(gone)} gone, {len(new)} new")
    return 1 if gone else 0


if __name__ == "__main__":
    sys.exit(main())
