#!/usr/bin/env python3
"""Write docs/amr_decks.md: the state of every deck with levels of the format's public suite.

    SLUICE_DECKS=FOLDER tools/verify/amr_decks.py --sluice build/release/bin/sluice [--check]

A deck has levels when it holds <AMR> or several <Level>s, includes resolved. A deck that `sluice
check` finds good is run to its end; of any other the first fault is told. --check writes
nothing and fails when the page is not what it would write.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

LIMIT = 300  # seconds a deck
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "amr_decks.md"

HEAD = """# Decks with levels

Every deck of the format's public suite that has `<AMR>` or several `<Level>`s, and its state. This
page is written by `tools/verify/amr_decks.py`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify decks` checks that it holds. The decks are taken as they stand. Of
those that do not run the first thing that is missing is told, as `sluice check` says it.

"""


class NoDeck(Exception):
    """The file cannot be read as a deck; what it says can still be searched."""


def load(path):
    """The deck's root with its includes resolved; files lie beside the deck or in the suite."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        raise NoDeck(str(error)) from error
    resolve(root, path.parent)
    return root


def resolve(element, folder):
    for place, child in enumerate(list(element)):
        if child.tag != "include":
            resolve(child, folder)
            continue
        name = child.get("href", "")
        found = next((p for p in (folder / name, pathlib.Path(name)) if p.is_file()), None)
        if found is None:
            raise NoDeck(f"{name} does not exist")
        part = load(found)
        for step in (child.get("section") or "").strip("/").split("/"):
            below = part.find(step) if step and step != part.tag else part
            part = part if below is None else below
        element.remove(child)
        element.insert(place, part)


def levels_of(path):
    """What the deck says of levels, or None when it has none."""
    try:
        root = load(path)
    except NoDeck:
        text = re.sub(r"<!--.*?-->", "", path.read_text(errors="replace"), flags=re.DOTALL)
        return "not readable" if "<AMR" in text or text.count("<Level>") > 1 else None
    statics = len(root.findall("Grid/Level"))
    amr = root.find("AMR")
    if amr is None and statics < 2:
        return None
    if statics > 1:
        return f"{statics} fixed"
    most = (root.findtext("AMR/Regridder/max_levels") or "1").strip()
    return f"up to {most}" if int(most) > 1 else "one"


def component_of(path):
    try:
        found = load(path).find("SimulationComponent")
    except NoDeck:
        return ""
    return "" if found is None else found.get("type", "")


def first_fault(sluice, suite, name):
    """The first error of the deck, or None; what is not built comes after real faults."""
    words = [sluice, "check", "--json", name]
    told = subprocess.run(words, cwd=suite, capture_output=True, text=True)
    faults = json.loads(told.stdout)["decks"][0]["faults"]
    errors = [f for f in faults if f["kind"] in ("error", "not_built")]
    errors.sort(key=lambda f: f["kind"] != "error")
    return errors[0]["message"] if errors else None


def run(sluice, suite, name):
    """(good, what to tell)"""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        words = [sluice, "run", name, "-o", folder, "--progress", "none", "--quiet", "--json",
                 str(report)]
        try:
            done = subprocess.run(words, cwd=suite, capture_output=True, text=True, timeout=LIMIT)
        except subprocess.TimeoutExpired:
            return False, f"not finished in {LIMIT} s"
        if done.returncode != 0:
            last = (done.stderr.strip() or done.stdout.strip() or "no message").splitlines()[-1]
            return False, re.sub(r"^\S+\.ups(:\d+)*: ", "", last)
        told = json.loads(report.read_text())
    if told["status"] not in ("done", "max_steps"):
        return False, f"ends with {told['status']}: {told['message']}"
    return True, f"runs to its end, {told['steps']} coarse steps"


def row(sluice, suite, path):
    name = path.relative_to(suite).as_posix()
    levels = levels_of(path)
    if levels is None:
        return None
    fault = first_fault(sluice, suite, name)
    if fault:
        good, text = False, "missing: " + fault.replace(" is known to the format, but not built "
                                                        "yet", "")
    else:
        good, text = run(sluice, suite, name)
    text = re.sub(r"(<[^<>]+>)", r"`\1`", text).replace("|", "\\|")
    return good, f"| {name.removeprefix('inputs/')} | {component_of(path)} | {levels} | {text} |\n"


def make_page(sluice, suite):
    rows = []
    back = pathlib.Path.cwd()
    os.chdir(suite)  # includes are also looked for here
    try:
        for path in sorted((suite / "inputs").rglob("*.ups")):
            rows.append(row(sluice, suite, path))
    finally:
        os.chdir(back)
    rows = [r for r in rows if r is not None]
    running = [text for good, text in rows if good]
    text = HEAD
    text += f"{len(running)} of {len(rows)} decks run.\n\n"
    text += "| deck | component | levels | state |\n| --- | --- | --- | --- |\n"
    text += "".join(running) + "".join(line for good, line in rows if not good)
    return text, f"{len(running)} of {len(rows)} decks with levels run"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--check", action="store_true", help="compare with the page only")
    given = parser.parse_args()
    suite = os.environ.get("SLUICE_DECKS")
    if not suite:
        print("amr_decks: SLUICE_DECKS does not name the folder of the suite", file=sys.stderr)
        return 2
    suite = pathlib.Path(suite).resolve()
    text, told = make_page(str(pathlib.Path(given.sluice).resolve()), suite)
    if given.check:
        if not PAGE.exists() or PAGE.read_text() != text:
            print(f"RESULT: {PAGE.name} is out of date: write it anew without --check")
            return 1
    else:
        PAGE.write_text(text)
    print(f"RESULT: {told}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
