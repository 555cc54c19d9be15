#!/usr/bin/env python3
"""Check that the files, pages and headings that comments name exist.

A file is named by its name or the end of its path (surface.hpp, mixture/surface.hpp), a heading by
its title behind the page (theory_ice.md, "References") or as in a link (theory_ice.md#references).
Of Python files docstrings are read too.

    check_comments.py [FOLDER]      exit 0: no fault, 1: faults, each with file and line
"""
import ast
import io
import pathlib
import re
import tokenize

import cpp_text
import report
from check_lines import NAMES, tracked
from names import Names

def python_comments(text):
    comments = [(token.start[0], token.string[1:])
                for token in tokenize.generate_tokens(io.StringIO(text).readline)
                if token.type == tokenize.COMMENT]
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, kinds) and ast.get_docstring(node, clean=False):
            comments.append((node.body[0].lineno, node.body[0].value.value))
    return sorted(comments)


def other_comments(text):
    """Of shell and CMake; a text with a number sign in it may be taken for one."""
    return [(number, line[1]) for number, line in
            ((n, re.search(r"(?:^|\s)#(?!!)\s*(.*)", t)) for n, t in
             enumerate(text.splitlines(), 1)) if line]


def comments_of(file, text):
    if file.suffix in (".cpp", ".hpp", ".inc"):
        return cpp_text.comments(text)
    if file.suffix == ".py":
        return python_comments(text)
    return other_comments(text)


def check(root):
    root = pathlib.Path(root)
    names, faults = Names(root), []
    for file in sorted(tracked(root)):
        if file.suffix not in (".cpp", ".hpp", ".inc", ".py", ".sh", ".cmake") and \
                file.name not in NAMES:
            continue
        for line, words in comments_of(file, file.read_text(encoding="utf-8")):
            for place, fault in names.faults(words):
                number = line + words.count("\n", 0, place)
                faults.append(f"{file.relative_to(root)}:{number}: {fault}")
    return faults


if __name__ == "__main__":
    report.main("comments", check)
