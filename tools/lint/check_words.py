#!/usr/bin/env python3
"""Check the words that users read: string literals of src/, the README and generated pages.

    check_words.py [FOLDER]      exit 0: no fault, 1: faults, each with file, line and better word

Inside the project short words of its own are fine; what is printed is plain standard English.
"""
import pathlib
import re

import report

# Pattern of a word, and what to write in its place.
COUNTED = (r"(?:\{[^{}]*\}|\d[\d,.]*|doubles|numbers?|values?|bytes|cells|layers|lines?|patches|"
           r"threads|particles|(?:nano)?seconds|ns)")
UNIT = r"(?:cell|direction|rank|thread|step|block|box|pair|material|level)"
WORDS = [
    (re.compile(r"\bbuilt\b", re.IGNORECASE), "supported"),
    (re.compile(r"\busual(?:ly)?\b", re.IGNORECASE), "default"),
    (re.compile(r"\bhalo[ -]points?\b", re.IGNORECASE), "ghost exchange"),
    (re.compile(r"\b(?:sleep|sleeps|sleeping|asleep|slept)\b", re.IGNORECASE), "skipped blocks"),
    (re.compile(r"\bscenes?\b", re.IGNORECASE), "problem"),
    (re.compile(rf"(?<!\w){COUNTED} an? {UNIT}\b", re.IGNORECASE),
     "per cell, per rank, per step, ..."),
]
PAGES = ["README.md", "docs/deck_reference.md", "docs/labels.md"]
# What is right as it stands: (path, a piece of the text) -> reason.
EXCEPTIONS = {
    ("src/framework/base/communicator.cpp", "(built with {}.{} of the standard)"):
        "the program itself was built",
    ("src/framework/scene/make_piece.cpp", "the geometry piece <{}> cannot be built"):
        "a piece is built from its points",
}

TOKEN = re.compile(r"""
    //[^\n]* | /\*.*?\*/ | \#\s*include[^\n]*            # skipped
  | R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"
  | "(?P<text>(?:\\.|[^"\\\n])*)"
  | (?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'                  # a character; no digit separator
""", re.DOTALL | re.VERBOSE)


def literals(source):
    """(line, text) of every string literal; literals that follow each other are one."""
    found, end = [], None
    for token in TOKEN.finditer(source):
        text = token["text"] if token["raw"] is None else token["raw"]
        if text is None:
            continue
        if end is not None and not source[end:token.start()].strip():
            found[-1][1] += text
        else:
            found.append([source.count("\n", 0, token.start()) + 1, text])
        end = token.end()
    return [(line, text) for line, text in found]


def faults_of(path, texts):
    for line, text in texts:
        for pattern, better in WORDS:
            word = pattern.search(text)
            if word is None:
                continue
            if any(path == where and piece in text for where, piece in EXCEPTIONS):
                continue
            yield f"{path}:{line}: '{word[0]}' is no word for users (write: {better})"


def is_read_by_users(file):
    inner = file.stem.endswith(("_test", "_fuzz", "_test_support", "_mock"))
    return file.suffix in (".cpp", ".hpp", ".inc") and not inner


def check(root):
    root = pathlib.Path(root)
    faults = []
    for file in sorted((root / "src").rglob("*")):
        if file.is_file() and is_read_by_users(file):
            path = file.relative_to(root).as_posix()
            faults += faults_of(path, literals(file.read_text(encoding="utf-8")))
    for page in PAGES:
        if (root / page).is_file():
            lines = (root / page).read_text(encoding="utf-8").splitlines()
            faults += faults_of(page, enumerate(lines, 1))
    return faults


if __name__ == "__main__":
    report.main("words", check)
