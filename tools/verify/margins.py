#!/usr/bin/env python3
"""Hold the told distance of decks from failing against runs just below and just above it.

`sluice stability DECK` says "factor 1.4 of the step from failing"; 0.93 times that must hold and
1.07 times it must not. Of a deck whose step does not fail, the longest that is taken must hold.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

BELOW, ABOVE = 0.93, 1.07


def sluice(given, *words):
    return subprocess.run([given.sluice, *map(str, words)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False).stdout


def told(given, deck, folder):
    """The distance of the step and what must hold; None where the deck itself does not."""
    sluice(given, "stability", deck, "-o", folder, "--no-picture")
    found = json.loads((folder / "stability.json").read_text())
    if not found["distances"]:
        return None, 0
    must_hold = " ".join(found["cases"][0]["must_hold"])
    bounds = re.findall(r"total energy grows at most (\S+)", must_hold)
    return found["distances"][0], float(bounds[0]) if bounds else 1e300


def multiplier(given, deck):
    """What the deck writes for it, 1 where it writes nothing."""
    text = deck.read_text()
    start = text.find("<timestep_multiplier>")
    return float(text[start:].split(">")[1].split("<")[0]) if start >= 0 else 1.0


def verdicts(given, deck, factors, growth, folder):
    """Verdicts of runs at these factors of the step."""
    own = multiplier(given, deck)
    values = {f"{f:.4g}": [f"Time/timestep_multiplier={f * own:.9g}"] for f in factors}
    case = {"title": deck.stem, "why": "a told factor", "source": "sluice stability",
            "component": "fluid", "traits": [], "deck": str(deck),
            "must_hold": [{"quantity": "total energy", "grows_at_most": growth}],
            "sweeps": [{"name": "factor", "default": "1", "values": {"1": [], **values}}]}
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "factors.stability"
    file.write_text(json.dumps(case))
    sluice(given, "stability", file, "-o", folder / "check", "--no-picture")
    found = json.loads((folder / "check/stability.json").read_text())["cases"][0]["runs"]
    return {run["value"]: run["verdict"] for run in found if run.get("sweep") == "factor"}


def checked(given, deck):
    """One line of the result, and whether the told factor is right."""
    folder = given.folder / deck.stem
    distance, growth = told(given, deck, folder)
    if distance is None:
        return "does not hold at its own settings", False
    if distance["failed"] is None:
        found = verdicts(given, deck, [distance["held"] * BELOW], growth, folder)
        return f"told: holds up to {distance['held']:.3g}; found {found}", set(
            found.values()) == {"green"}
    factor = (distance["held"] * distance["failed"]) ** 0.5
    found = verdicts(given, deck, [factor * BELOW, factor * ABOVE], growth, folder)
    right = list(found.values())[0] == "green" and list(found.values())[-1] != "green"
    return f"told: factor {factor:.3g} from failing; found {found}", right


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("decks", nargs="+", type=pathlib.Path)
    given = parser.parse_args()
    right = 0
    for deck in given.decks:
        text, good = checked(given, deck.resolve())
        right += good
        print(f"{deck.stem}: {text}{'' if good else '  WRONG'}", flush=True)
    print(f"RESULT: {right} of {len(given.decks)} told factors are right")
    return 0 if right == len(given.decks) else 1


if __name__ == "__main__":
    sys.exit(main())
