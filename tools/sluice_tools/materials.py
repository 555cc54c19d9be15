"""Names of the materials of an archive: solids are numbered first, then fluids, in the order of the
deck.

    names(archive)                 # {0: "steel", 1: "air"}; "material 2" where the deck gives none
    number(archive, "air")         # 1, also of "1"
"""
import difflib
import re
import xml.etree.ElementTree as ElementTree

from .archive import ArchiveError

METHODS = ("MPM", "ICE")  # in the order of their numbers


def _decks(archive):
    """The deck as run; of a switcher those of its components."""
    found = []
    for path in [archive.path / "input.xml", *sorted(archive.path.glob("input_*.xml"))]:
        try:
            found.append(ElementTree.parse(path).getroot())
        except (OSError, ElementTree.ParseError):
            continue
    return found


def deck(archive):
    """The deck that tells the materials, or None."""
    return next((d for d in _decks(archive) if d.find("MaterialProperties") is not None), None)


def elements(archive):
    """[(method, element)] of the deck's materials, by number."""
    root = deck(archive)
    if root is None:
        return []
    return [(method, e) for method in METHODS
            for e in root.iterfind(f"MaterialProperties/{method}/material")]


def names(archive):
    """By number, for all numbers of which the deck or the fields of the archive know."""
    told = {n: (e.get("name") or "").strip() for n, (_, e) in enumerate(elements(archive))}
    count = max([v.materials for v in archive.variables.values()] + [len(told), 1])
    return {n: told.get(n) or f"material {n}" for n in range(count)}


def name(archive, material):
    return names(archive).get(material, f"material {material}")


def number(archive, text):
    """The number of a material that is given by its name or its number."""
    known = names(archive)
    plain = str(text).strip()
    if re.fullmatch(r"\d+", plain):
        return int(plain)
    found = [n for n, word in known.items() if word == plain]
    found = found or [n for n, word in known.items() if word.lower() == plain.lower()]
    if found:
        return found[0]
    near = difflib.get_close_matches(plain, known.values(), 1)
    raise ArchiveError(f"no material '{text}'" + (f"; did you mean '{near[0]}'?" if near else "") +
                       "; there are: " + ", ".join(f"{n}: {w}" for n, w in known.items()))
