"""Names of files, pages and headings in prose, and whether they exist."""
import functools
import re

from check_links import CODE, HEADING, anchor
from check_lines import tracked

ENDINGS = "cpp|hpp|inc|py|md|sh|cmake|rows|tsv"
# A file by its name or by the end of its path; also with the anchor or the title of a heading.
FILE = re.compile(rf"(?<![\w./<>*{{}}$-])((?:[\w.-]+/)*[\w.-]*\w\.(?:{ENDINGS}))(?![\w/(])"
                  r"(?:#([\w-]+)|,\s+\"([^\"]+)\")?")
# A page of docs/ by its bare name: mpm_transfers, section 3.
PAGE = re.compile(r"\b([a-z]\w*_\w+),?\s+section\b")
# Headers that CMake writes.
GENERATED = {"sluice_version.hpp", "sluice_source_dir.hpp"}


class Names:
    """The files of a folder, as prose may name them."""

    def __init__(self, root):
        self.root = root
        self.paths = {f.relative_to(root).as_posix() for f in tracked(root)}
        self.endings = set(GENERATED)
        for path in self.paths:
            parts = path.split("/")
            self.endings |= {"/".join(parts[n:]) for n in range(len(parts))}

    def has(self, path):
        while path.startswith(("./", "../")):
            path = path.partition("/")[2]
        return path in self.endings

    @functools.cache
    def headings(self, page):
        """Titles of the pages whose path ends so."""
        titles = set()
        for path in self.paths:
            if path == page or path.endswith("/" + page):
                text = CODE.sub("", (self.root / path).read_text(encoding="utf-8"))
                titles |= {re.sub(r"[`*]", "", title) for title in HEADING.findall(text)}
        return titles

    def faults(self, text):
        """(place in the text, what is wrong) of each name there that leads nowhere."""
        for name in FILE.finditer(text):
            path, mark, title = name.groups()
            stem = path.rpartition("/")[2].partition(".")[0]
            if re.search(r"[A-Z]{3}", stem) and not self.has(path):
                continue  # NAME_command.cpp: a pattern of names
            if not self.has(path):
                yield name.start(), f"there is no file '{path}'"
            elif path.endswith(".md"):
                titles = self.headings(path)
                if title and re.sub(r"\s+", " ", title) not in titles or \
                        mark and mark not in {anchor(t) for t in titles}:
                    yield name.start(), f"{path} has no heading '{mark or title}'"
        for name in PAGE.finditer(text):
            if not self.has(name[1] + ".md"):
                yield name.start(), f"there is no page '{name[1]}'"
