#!/usr/bin/env python3
"""Run decks as they stand; each must end with status done and totals conserved as it says itself.

Own decks: every .ups under --inputs. Suite: the decks of the format's public suite that
regression/promised_decks.txt names, from the suite's folder. Each run has a wall limit; one that
reaches it is reported as such, which is a failure.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

from promised import promised_decks

LIMIT = 700  # seconds a deck
BUDGET = 1700  # seconds in all: the part's limit less some room


def fault_of(words, folder):
    """Why a command failed; empty: it did not."""
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"not finished in {LIMIT} s"
    if done.returncode == 0:
        return ""
    last = (done.stderr.strip() or done.stdout.strip()).splitlines()
    return f"exit {done.returncode}: {last[-1] if last else 'no message'}"


def drive(given, deck):
    """A deck of one particle (<MaterialDriver>)."""
    fault = fault_of([given.sluice, "drive", str(deck)], given.inputs)
    return not fault, fault or "driven"


def run(given, deck, folder, options):
    report = folder / "report.json"
    words = [given.sluice, "run", str(deck), "-o", str(folder), "--progress", "none", "--json",
             str(report), *options]
    began = time.monotonic()
    fault = fault_of(words, given.suite or given.inputs)
    if fault:
        return False, fault
    told = json.loads(report.read_text())
    text = f"{told['status']}, {told['steps']} steps, {time.monotonic() - began:.1f} s"
    return told["status"] in ("done", "max_steps"), text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--inputs", required=True, type=pathlib.Path)
    parser.add_argument("--suite", type=pathlib.Path)
    given = parser.parse_args()

    jobs = [(deck, []) for deck in sorted(given.inputs.rglob("*.ups"))]
    if given.suite:
        jobs += [(given.suite / "inputs" / name, options)
                 for name, options in promised_decks().items()]
    began, failed, skipped = time.monotonic(), [], []
    for number, (deck, options) in enumerate(jobs):
        if time.monotonic() - began > BUDGET - LIMIT:
            skipped.append(deck.name)
            continue
        folder = given.folder / f"{number:02d}_{deck.stem}"
        folder.mkdir()
        good, text = (drive(given, deck) if deck.parent.name == "drive"
                      else run(given, deck, folder, options))
        print(f"   {'good  ' if good else 'FAILED'} {deck.name}: {text}", flush=True)
        if not good:
            failed.append(deck.name)
    ran = len(jobs) - len(skipped)
    told = f"{ran - len(failed)} of {len(jobs)} decks ran"
    told += f"; failed: {', '.join(failed)}" if failed else ""
    told += f"; no time left for: {', '.join(skipped)}" if skipped else ""
    told += "" if given.suite else "; the public suite was not there"
    print(f"RESULT: {told}")
    return 1 if failed or skipped else 0


if __name__ == "__main__":
    sys.exit(main())
