#!/usr/bin/env python3
"""Write docs/LIST_decks.md: the state of every deck of a list of the format's public suite.

    SLUICE_DECKS=FOLDER tools/verify/suite_decks.py --sluice build/release/bin/sluice LIST...

LIST is amr (decks with <AMR> or several <Level>s, run for some coarse steps), ice (decks of
inputs/ICE, coarsened to seconds), mpm (decks of solids, a few steps), impm (implicit steps,
likewise), mpmice (fluid and solids, a few steps), suite (all of them) or vaango (Vaango's suite, in
the folder that SLUICE_VAANGO_DECKS names). A deck that `sluice
check` finds good is run; of any other the first fault is told. --check writes nothing and fails
when a page is not what it would write. --test is quick: `sluice check` must find every deck good
that the page says runs, and one deck of each kind is run for a few steps; exit 77 means that
SLUICE_DECKS is not set. Whatever a page says, the decks of regression/promised_decks.txt run.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import sys

from suite_limits import QUICK_STEPS
from suite_lists import LISTS, IceList, promised, rows_of
from suite_reading import short_name
from suite_runs import faults_of, first_of, run_coarsened, state_of

NO_SUITE = 77


def make_page(sluice, suite, deck_list, only=""):
    """The page's text, what to tell of it, the names of the decks that run. Decks whose names do
    not match `only` keep their rows."""
    kept = rows_of(deck_list.page) if only else {}

    def row(path):
        cells = deck_list.cells(path)
        if cells is None:
            return None
        if short_name(suite, path) in kept and not re.search(only, short_name(suite, path)):
            good, line = kept[short_name(suite, path)]
            return good, short_name(suite, path), line
        good, state = state_of(sluice, suite, path, deck_list.run_deck)
        name = short_name(suite, path)
        return good, name, f"| {' | '.join([name, *cells, state])} |\n"

    paths = sorted(p for f in deck_list.folders for p in (suite / f).rglob("*.ups"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [found for found in pool.map(row, paths) if found is not None]
    running = [line for good, _, line in rows if good]
    text = deck_list.head
    accepted = sum(not re.search(r"\| (missing|fault of the deck): [^|]*\|$", line)
                   for _, _, line in rows)
    counts = getattr(deck_list, "counts", False)
    count = f"{accepted} of {len(rows)} decks are accepted, {len(running)} run.\n\n"
    text += count if counts else f"{len(running)} of {len(rows)} decks run.\n\n"
    text += deck_list.columns
    text += "".join(running) + "".join(line for good, _, line in rows if not good)
    told = f"{len(running)} of {len(rows)} {deck_list.told}"
    told += f", {accepted} are accepted" if counts else ""
    return text, told, {name for good, name, _ in rows if good}


def broken_decks(sluice, suite):
    """Of the fluid's decks that the page says run, or that are promised: what `sluice check` finds
    bad, and decks of a kind whose first steps fail; how many were checked and run."""
    names = set(re.findall(r"^\| (\S+\.ups) \|.*\| runs[^|]*\|$", IceList.page.read_text(), re.M))
    names |= promised(suite, IceList)
    names = sorted(names)
    told = faults_of(sluice, suite, [f"inputs/{name}" for name in names])
    broken = [f"{name}: {first_of(faults)}" for name, faults in zip(names, told, strict=True)
              if first_of(faults)]
    for name in (f"ICE/{short}.ups" for short in IceList.quick):
        if name not in names:
            broken.append(f"{name}: the page does not say that it runs")
            continue
        good, state = run_coarsened(sluice, suite, suite / "inputs" / name, QUICK_STEPS)
        if not good:
            broken.append(f"{name}: {state}")
    return broken, len(names), len(IceList.quick)


def test(sluice, suite):
    """Whether the quick test passes; says what was found."""
    broken, checked, run_here = broken_decks(sluice, suite)
    for line in broken:
        print(f"   FAILED {line}")
    print(f"RESULT: {checked} decks of the fluid checked, {run_here} run for {QUICK_STEPS} steps, "
          f"{len(broken)} faults")
    return checked > 0 and not broken


def says_the_same(page, text):
    """Decks that one of them did not finish within the limit may be done where a machine is faster:
    their rows, and the line that counts rows, are not compared."""
    slow = set(re.findall(r"^\| (\S+) \|.*not finished in", page + text, re.M))

    def compared(lines):
        return [line for line in lines.splitlines()
                if not re.match(r"\d+ of \d+ decks ", line)
                and not (line.startswith("| ") and line.split()[1] in slow)]
    return compared(page) == compared(text)


def treat(sluice, suite, deck_list, given):
    """Whether all is well with a list; says what was found."""
    text, told, running = make_page(sluice, suite, deck_list, given.only)
    lost = promised(suite, deck_list) - running
    if lost:
        print(f"RESULT: promised, but do not run: {', '.join(sorted(lost))}")
        return False
    if not given.check:
        deck_list.page.write_text(text)
    elif not deck_list.page.exists() or not says_the_same(deck_list.page.read_text(), text):
        print(f"RESULT: {deck_list.page.name} is out of date: write it anew without --check")
        return False
    print(f"RESULT: {told}")
    return True


def enter_suite(variable):
    """The folder of a suite, which becomes the working folder; None: the variable is not set."""
    suite = os.environ.get(variable)
    if not suite:
        print(f"suite_decks: {variable} does not name the folder of the suite", file=sys.stderr)
        return None
    suite = pathlib.Path(suite).resolve()
    os.chdir(suite)  # includes are also looked for here
    return suite


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--check", action="store_true", help="compare with the pages only")
    parser.add_argument("--only", default="", metavar="PATTERN",
                        help="decks whose names match; the others keep their rows")
    parser.add_argument("--test", action="store_true",
                        help="check the decks of the fluid that run, run some steps of a few")
    parser.add_argument("lists", nargs="*", metavar="LIST", help=", ".join(sorted(LISTS)))
    given = parser.parse_args()
    if bool(given.lists) == given.test or not set(given.lists) <= LISTS.keys():
        parser.error(f"give lists of {', '.join(sorted(LISTS))}, or --test")
    sluice = str(pathlib.Path(given.sluice).resolve())
    if given.test:
        suite = enter_suite("SLUICE_DECKS")
        return NO_SUITE if suite is None else 0 if test(sluice, suite) else 1
    good = []
    for name in given.lists:
        suite = enter_suite(getattr(LISTS[name], "variable", "SLUICE_DECKS"))
        if suite is None:
            return 2
        good.append(treat(sluice, suite, LISTS[name], given))
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
