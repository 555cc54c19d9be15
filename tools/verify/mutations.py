#!/usr/bin/env python3
"""Check decks that are mutated at random; every command must end with 0, 1 or 2, and say why.

Decks are those of inputs/ and of the suites whose folders are given. Each is changed in one to
three places: a tag, an attribute or a number is removed, doubled, moved, renamed or replaced, a
piece is scaled, or the text is cut. `sluice check` judges it; what it finds good is planned, and
takes STEPS steps where it has few cells. A crash, an exit status other than 0,
1 and 2, a refusal without a word, or a command that takes more than LIMIT is a fault, and the deck
is kept. Every number follows from the seed alone, which is the number of the deck.
"""
import argparse
import concurrent.futures
import pathlib
import random
import re
import signal
import subprocess
import sys

LIMIT = 10  # seconds of a core: other work on the machine does not count
HANGS = 200  # seconds of the clock
STEPS = 5
MOST_CELLS = 20_000  # of a deck that takes steps
TAG = re.compile(r"<(\w+)((?:\s[^<>]*?)?)(/?)>")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
NUMBERS = ["0", "-1", "1", "1e300", "-1e300", "1e-300", "nan", "inf", "2147483648", "-0.0", "1e999",
           "0.5", "3", "1.5d-3", "", "x", "999999", "[1,2,3]", "true", "1,2", "--1"]
WORDS = ["", "true", "false", "none", "all", "0", "-1", "[0,0,0]", "[1,1,1]", "[]", "x" * 300, "%s",
         "../..", "\u00e9", "&amp;", "linear", "implicit", "mpm", "ice", "mpmice"]


def element_at(text, found):
    """The whole element whose opening tag was found, as far as the text shows it."""
    if found.group(3):
        return found.start(), found.end()
    end = text.find(f"</{found.group(1)}>", found.end())
    return found.start(), found.end() if end < 0 else end + len(found.group(1)) + 3


def mutate_once(text, draw, words):
    tags = list(TAG.finditer(text))
    numbers = list(NUMBER.finditer(text))
    if not tags or not numbers:
        return text[: draw.randrange(len(text) + 1)]
    kind = draw.choice(["remove"] * 4 + ["double", "move", "swap"] + ["rename"] * 2 + ["number"] * 6
                       + ["text"] * 3 + ["attribute"] * 3 + ["cut", "noise"] + ["scale"] * 2)
    found = draw.choice(tags)
    begin, end = element_at(text, found)
    if kind == "remove":
        return text[:begin] + text[end:]
    if kind == "double":
        return text[:end] + text[begin:end] + text[end:]
    if kind in ("move", "swap"):
        other, other_end = element_at(text, draw.choice(tags))
        if not (end <= other or other_end <= begin):
            return text
        if begin > other:
            (begin, end), (other, other_end) = (other, other_end), (begin, end)
        first, second = text[begin:end], text[other:other_end]
        kept = second if kind == "swap" else ""
        return text[:begin] + kept + text[end:other] + first + text[other_end:]
    if kind == "scale":
        factor = draw.choice([-1, 0, 0.01, 0.5, 2, 10, 1e3, 1e9])
        inside = NUMBER.sub(lambda n: f"{float(n.group()) * factor:.6g}", text[begin:end])
        return text[:begin] + inside + text[end:]
    if kind == "rename":
        return text[: found.start(1)] + draw.choice(words) + text[found.end(1):]
    if kind == "number":
        n = draw.choice(numbers)
        return text[: n.start()] + draw.choice(NUMBERS) + text[n.end():]
    if kind == "text":
        close = text.find("<", found.end())
        return text[: found.end()] + draw.choice(WORDS + NUMBERS) + text[max(close, found.end()):]
    if kind == "attribute":
        changed = re.sub(r'"[^"]*"', '"' + draw.choice(WORDS[:-6] + words[:20]) + '"',
                         found.group(0), count=1)
        return text[: found.start()] + changed + text[found.end():]
    if kind == "cut":
        at = draw.randrange(len(text))
        return text[:at] + text[at + draw.randrange(1, 400):]
    at = draw.randrange(len(text))
    return text[:at] + chr(draw.randrange(1, 255)) + text[at:]


def mutated(text, draw, words):
    for _ in range(draw.choice([1, 1, 1, 1, 2, 2, 3])):
        text = mutate_once(text, draw, words)
    return text


def outcome(words, folder):
    """(exit status or None, what was printed)"""
    try:
        done = subprocess.run(["bash", "-c", f'ulimit -t {LIMIT}; exec "$@"', "bash", *words],
                              cwd=folder, capture_output=True, timeout=HANGS)
    except subprocess.TimeoutExpired:
        return None, b""
    stopped = done.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return None if stopped else done.returncode, done.stdout + done.stderr


def fault_of(status, told):
    if status is None:
        return f"takes more than {LIMIT} s"
    if status not in (0, 1, 2):
        last = told.decode(errors="replace").strip().splitlines()[-1:] or ["no message"]
        return f"exit {status}: {last[0][:200]}"
    return "says nothing" if status != 0 and not told.strip() else ""


def cells_of(text):
    """As far as the text says it: those of levels that have a spacing are not counted here."""
    most = MOST_CELLS + 1 if "<spacing>" in text else 1
    for found in re.findall(r"<resolution>\s*\[([^\]]*)\]", text):
        count = 1
        for part in found.split(","):
            count *= int(part) if part.strip().lstrip("-").isdigit() else 1
        most += count
    return most


def judge(sluice, root, deck):
    """(how far the deck came, what is wrong)"""
    status, told = outcome([sluice, "check", str(deck)], root)
    fault = fault_of(status, told)
    if fault or status != 0:
        return "refused", fault and "check " + fault
    status, told = outcome([sluice, "plan", str(deck)], root)
    fault = fault_of(status, told)
    if fault or cells_of(deck.read_text(errors="replace")) > MOST_CELLS:
        return "planned", fault and "plan " + fault
    status, told = outcome([sluice, "run", str(deck), "--no-output", "--max-steps", str(STEPS),
                            "--progress", "none"], root)
    fault = fault_of(status, told)
    return "run", fault and "run " + fault


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("roots", nargs="+", type=pathlib.Path)
    given = parser.parse_args()

    decks = [(root, deck) for root in given.roots
             for deck in sorted((root / "inputs").rglob("*.ups"))]
    texts = {deck: deck.read_text(errors="replace") for _, deck in decks}
    words = sorted({found.group(1) for text in texts.values() for found in TAG.finditer(text)})

    def one(number):
        draw = random.Random(number)
        root, source = draw.choice(decks)
        deck = given.folder / f"mutated_{number}.ups"
        deck.write_text(mutated(texts[source], draw, draw.sample(words, 50)), errors="replace")
        came, fault = judge(given.sluice, root, deck.resolve())
        if not fault:
            deck.unlink()
        return number, source, came, fault

    counts, failed = {}, 0
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for number, source, came, fault in pool.map(one, range(given.first,
                                                               given.first + given.count)):
            counts[came] = counts.get(came, 0) + 1
            if fault:
                failed += 1
                print(f"   FAILED {number} (of {source.name}): {fault}", flush=True)
    told = ", ".join(f"{counts.get(came, 0)} {came}" for came in ("refused", "planned", "run"))
    print(f"RESULT: {given.count} decks mutated at random (seeds {given.first} to "
          f"{given.first + given.count - 1}): {told} {STEPS} steps; {failed} faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
