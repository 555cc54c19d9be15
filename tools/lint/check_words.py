#!/usr/bin/env python3
"""Check the words of string literals, pages and comments against the vocabulary in words.tsv.

    check_words.py [FOLDER]      exit 0: no fault, 1: faults, each with file, line and better word

The head of words.tsv describes its rows. A page or folder that is finished is checked completely;
of the other sources only the string literals are, because users read them.
"""
import functools
import pathlib
import re
from typing import NamedTuple

import report

TABLE = pathlib.Path(__file__).with_name("words.tsv")
COLUMNS = ["kind", "what", "where", "old", "new", "reason"]
KINDS = ["phrase", "finished", "later", "symbol", "folder"]
# Pages that are written from string literals of src.
GENERATED = ["docs/deck_reference.md", "docs/labels.md"]
# What is right as it stands: (path, a piece of the text) -> reason.
EXCEPTIONS = {
    ("src/framework/base/communicator.cpp", "(built with {}.{} of the standard)"):
        "the program itself was built",
    ("src/framework/scene/make_piece.cpp", "the geometry piece <{}> cannot be built"):
        "a piece is built from its points",
    ("src/ice/cut_cells/materials.cpp", "cells that solids touch"):
        "the name of a task, which tables of costs and graphs show",
}

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/) | \#\s*include[^\n]*
  | R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"
  | "(?P<text>(?:\\.|[^"\\\n])*)"
  | (?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'                  # a character; no digit separator
""", re.DOTALL | re.VERBOSE)
CODE = re.compile(r"^```.*?^```|`[^`\n]*`|\$\$.*?\$\$|\]\([^)\s]*\)|<a id=\"[^\"]*\"></a>",
                  re.MULTILINE | re.DOTALL)
COMMENT_MARK = re.compile(r"^[ \t]*///?!?", re.MULTILINE)


class Row(NamedTuple):
    kind: str
    what: str
    where: str
    old: str
    new: str
    reason: str


@functools.cache
def table(path=TABLE):
    """The rows of the vocabulary; a row that cannot be read is a fault of the table."""
    rows = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        fields = line.split("\t")
        if not line or line.startswith("#") or fields == COLUMNS:
            continue
        if len(fields) > len(COLUMNS) or fields[0] not in KINDS:
            raise ValueError(f"{path.name}:{number}: expected a kind ({', '.join(KINDS)}) and "
                             f"at most {len(COLUMNS)} columns")
        rows.append(Row(*fields + [""] * (len(COLUMNS) - len(fields))))
    return rows


@functools.cache
def phrases(what):
    """(pattern, better words) of every phrase; a blank of a pattern matches a line end too."""
    return [(re.compile(r.old.replace(" ", r"[ \t]*(?:[ \t]|\n)[ \t]*"), re.IGNORECASE), r.new)
            for r in table() if r.kind == "phrase" and r.what == what]


def finished(path):
    """Whether the page or the source is one whose text is checked completely."""
    file = pathlib.PurePosixPath(path)
    return any(r.kind == "finished"
               and (file.match(r.where) or f"{path}/".startswith(f"{r.where}/"))
               for r in table())


def for_later(path):
    return any(r.kind == "later" and path.startswith(f"{r.where}/") for r in table())


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


def comments(source):
    """(line, text) of every comment; comments on lines that follow each other are one."""
    found, end = [], None
    for token in TOKEN.finditer(source):
        if token["comment"] is None:
            continue
        text = COMMENT_MARK.sub("", token["comment"])
        if end is not None and re.fullmatch(r"[ \t]*\n[ \t]*", source[end:token.start()]):
            found[-1][1] += "\n" + text
        else:
            found.append([source.count("\n", 0, token.start()) + 1, text])
        end = token.end()
    return [(line, text) for line, text in found]


def prose(page):
    """The text of a page, with blanks for code, formulas and addresses."""
    return CODE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), page)


def faults_of(path, texts, what="printed"):
    for line, text in texts:
        for pattern, better in phrases(what):
            for word in pattern.finditer(text):
                if any(path == p and piece in text for p, piece in EXCEPTIONS):
                    continue
                shown = " ".join(word[0].split())
                yield (f"{path}:{line + text.count(chr(10), 0, word.start())}: "
                       f"'{shown}' is no word for users (write: {better})")


def is_read_by_users(file):
    inner = file.stem.endswith(("_test", "_fuzz", "_test_support", "_mock"))
    return file.suffix in (".cpp", ".hpp", ".inc") and not inner


def faults_of_source(path, source):
    texts = literals(source)
    yield from faults_of(path, texts)
    if not for_later(path):
        yield from faults_of(path, texts, "prose")
    if finished(path):
        yield from faults_of(path, comments(source), "prose")


def faults_of_page(path, page):
    if path in GENERATED or path == "README.md":
        yield from faults_of(path, enumerate(page.splitlines(), 1))
    if path not in GENERATED and finished(path):
        yield from faults_of(path, [(1, prose(page))], "prose")


def check(root):
    root = pathlib.Path(root)
    faults = []
    for file in sorted((root / "src").rglob("*")):
        if file.is_file() and is_read_by_users(file):
            faults += faults_of_source(file.relative_to(root).as_posix(),
                                       file.read_text(encoding="utf-8"))
    for page in [*sorted(root.glob("*.md")), *sorted((root / "docs").rglob("*.md"))]:
        faults += faults_of_page(page.relative_to(root).as_posix(),
                                 page.read_text(encoding="utf-8"))
    return faults


if __name__ == "__main__":
    report.main("words", check)
