#!/usr/bin/env python3
"""Write the index of the decks of each folder of inputs/, from the heads of the decks.

The head of a deck, the first comment of its file, says in this order: Subject, a word of SUBJECTS;
Problem; Reference, what the result is compared with; Run time, on one core; Expect. A picture is
that of docs/gallery.md, or the study of regression/accuracy that runs the deck.

    deck_pages.py
"""
import json
import math
import pathlib
import re
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tools" / "lint"))
from check_links import anchor  # noqa: E402

PAGE = "README.md"
KEYS = ["Subject", "Problem", "Reference", "Run time", "Expect"]
# folder -> word of the heads -> heading of the page, in the order of the page.
SUBJECTS = {
    "ice": {
        "shocks": "Shock tubes, strong shocks and blasts of one material",
        "smooth": "Waves, vortices and other smooth flow",
        "boundaries": "Open boundaries, inlets and walls",
        "viscosity": "Viscosity, heat conduction and slip at walls",
        "materials": "Several materials",
        "reactions": "Reactions and detonations",
        "gravity": "Gravity",
        "turbulence": "Turbulence",
        "implicit": "Semi-implicit pressure: steps beyond the limit of sound",
        "refinement": "Adaptive refinement",
    },
    "mpm": {
        "motion": "Motion, bars and waves",
        "contact": "Contact, friction and cohesion",
        "plasticity": "Plasticity and strong shocks",
        "statics": "Static loads, by damping",
        "heat": "Heat and pore water",
        "implicit": "Implicit steps",
    },
    "peridynamics": {
        "elastic": "Elastic bodies",
        "cracks": "Cracks",
    },
    "mpmice": {
        "flow": "Flow past bodies and between plates",
        "shocks": "Shocks and sound against solids",
        "motion": "Bodies that move with the fluid",
        "heat": "Heat through the surfaces of solids",
        "burning": "Burning solids",
        "implicit": "Semi-implicit pressure",
    },
    "examples": {"examples": "Components to learn from"},
    "templates": {"templates": "Templates of `sluice new`"},
    "bench": {
        "coupled": "Fluid and solids",
        "solids": "Solids in explicit steps",
        "implicit": "Solids in implicit steps",
    },
}
HEADS = {
    "ice": "Decks of the fluid", "mpm": "Decks of solids", "mpmice": "Decks of fluid and solids",
    "peridynamics": "Decks of peridynamic solids",
    "examples": "Decks of the example components", "templates": "Decks to begin with",
    "bench": "Decks of the bench",
}
CLASSES = [1, 2, 5, 10, 20]  # s; finer would say more of the machine than of the deck
UNITS = {"s": 1, "min": 60}


class HeadFault(ValueError):
    """A head that the index cannot be made from."""


def head(text):
    """The head of a deck as {key: text}, in its order."""
    comment = re.search(r"<!--(.*?)-->", text, re.DOTALL)
    words = comment[1] if comment else ""
    parts = re.split(rf"^  ({'|'.join(KEYS)}): +", words, flags=re.MULTILINE)
    return {key: " ".join(part.split()) for key, part in zip(parts[1::2], parts[2::2])}


def seconds(words):
    """The seconds at the begin of a run time."""
    found = re.match(r"(\d+(?:\.\d+)?) (s|min)\b", words)
    if not found:
        raise HeadFault(f"Run time: '{words}' does not begin with a number and s or min")
    return float(found[1]) * UNITS[found[2]]


def time_class(words):
    bound = next((c for c in CLASSES if seconds(words) <= c), math.inf)
    return f"{bound} s" if bound < math.inf else f"over {CLASSES[-1]} s"


def checked(folder, text):
    """The head of a deck with all that the index needs."""
    found = head(text)
    if list(found) != KEYS:
        raise HeadFault(f"its head has {', '.join(found) or 'nothing'}, not {', '.join(KEYS)}")
    if found["Subject"] not in SUBJECTS[folder]:
        raise HeadFault(f"Subject: '{found['Subject']}' is none of {', '.join(SUBJECTS[folder])}")
    seconds(found["Run time"])
    return found


def pictures(root):
    """deck -> link to what shows it, of the gallery or of a study of its accuracy."""
    links = {}
    for study in sorted((root / "regression/accuracy").glob("*.study")):
        lines = study.read_text(encoding="utf-8").splitlines()
        settings = json.loads("\n".join(l for l in lines if not l.startswith("//")))
        deck = (study.parent / settings["deck"]).resolve().relative_to(root.resolve())
        picture = root / "docs/accuracy" / f"{study.stem}.png"
        if picture.is_file():
            links.setdefault(deck.as_posix(), f"[error](../../docs/accuracy/{picture.name})")
    gallery = root / "docs/gallery.md"
    sections = gallery.read_text(encoding="utf-8") if gallery.is_file() else ""
    for section in re.split(r"^## ", sections, flags=re.MULTILINE)[1:]:
        deck = re.search(r"inputs/\w+/\w+\.ups", section)
        if deck:
            title = anchor(section.partition("\n")[0])
            links[deck[0]] = f"[picture](../../docs/gallery.md#{title})"
    return links


def page(root, folder):
    """The page of a folder; throws a HeadFault that names the deck."""
    rows, links = {word: [] for word in SUBJECTS[folder]}, pictures(root)
    for deck in sorted((root / "inputs" / folder).glob("*.ups")):
        try:
            found = checked(folder, deck.read_text(encoding="utf-8"))
        except HeadFault as fault:
            raise HeadFault(f"{deck.relative_to(root).as_posix()}: {fault}") from fault
        cells = [f"[{deck.stem}]({deck.name})", found["Problem"], found["Reference"],
                 time_class(found["Run time"]),
                 links.get(deck.relative_to(root).as_posix(), "")]
        rows[found["Subject"]].append(
            "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    lines = [f"# {HEADS[folder]}", "",
             "This page is written by `./dev docs` from the heads of the decks; "
             f"`./dev run inputs/{folder}/DECK.ups` runs one.",
             "The run time is an upper bound for one core, in classes of "
             f"{', '.join(map(str, CLASSES))} s and more.",
             "The picture is that of the gallery, or shows the error against the run time.", ""]
    for word, heading in SUBJECTS[folder].items():
        lines += [f"## {heading}", "", "| deck | problem | reference | run time | picture |",
                  "| --- | --- | --- | --- | --- |", *rows[word], ""]
    return "\n".join(lines)


def main():
    for folder in SUBJECTS:
        (PROJECT / "inputs" / folder / PAGE).write_text(page(PROJECT, folder), encoding="utf-8")


if __name__ == "__main__":
    try:
        main()
    except HeadFault as fault:
        sys.exit(str(fault))
