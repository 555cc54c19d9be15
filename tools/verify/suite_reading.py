"""What decks of the suites say of themselves, as far as the pages and runs need it."""
import math
import pathlib
import re
import xml.etree.ElementTree as ElementTree

from suite_limits import MOST_CELLS


class NoDeck(Exception):
    """The file cannot be read as a deck; what it says can still be searched."""


def load(path):
    """The deck's root with its includes resolved; files lie beside the deck or in the suite."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        raise NoDeck(str(error)) from error
    resolve(root, path.parent)
    return root


def resolve(element, folder):
    for place, child in enumerate(list(element)):
        if child.tag != "include":
            resolve(child, folder)
            continue
        name = child.get("href", "")
        found = next((p for p in (folder / name, pathlib.Path(name)) if p.is_file()), None)
        if found is None:
            raise NoDeck(f"{name} does not exist")
        part = load(found)
        for step in (child.get("section") or "").strip("/").split("/"):
            below = part.find(step) if step and step != part.tag else part
            part = part if below is None else below
        element.remove(child)
        element.insert(place, part)


def levels_of(path):
    """What the deck says of levels, or None when it has none."""
    try:
        root = load(path)
    except NoDeck:
        text = re.sub(r"<!--.*?-->", "", path.read_text(errors="replace"), flags=re.DOTALL)
        return "not readable" if "<AMR" in text or text.count("<Level>") > 1 else None
    statics = len(root.findall("Grid/Level"))
    amr = root.find("AMR")
    if amr is None and statics < 2:
        return None
    if statics > 1:
        return f"{statics} fixed"
    most = (root.findtext("AMR/Regridder/max_levels") or "1").strip()
    return f"up to {most}" if int(most) > 1 else "one"


def component_of(path):
    try:
        found = load(path).find("SimulationComponent")
    except NoDeck:
        return ""
    return "" if found is None else found.get("type", "")


def materials_of(path):
    try:
        return str(len(load(path).findall("MaterialProperties/ICE/material")))
    except NoDeck:
        return ""


def models_of(path):
    """The constitutive models that the deck names."""
    try:
        found = load(path).iterfind("MaterialProperties/MPM/material/constitutive_model")
    except NoDeck:
        return ""
    return ", ".join(sorted({model.get("type", "") for model in found}))


def coarsened(path, most=MOST_CELLS):
    """Overrides that make the deck small, and the cells it then has (None: as it stands)."""
    levels = load(path).findall("Grid/Level")
    boxes = levels[0].findall("Box") if len(levels) == 1 else []
    if len(boxes) != 1 or boxes[0].find("resolution") is None:
        return [], None
    cells = [int(part) for part in boxes[0].findtext("resolution").strip(" []\n").split(",")]
    if math.prod(cells) <= most:
        return [], None
    long = [n for n in cells if n > 1]
    factor = (math.prod(cells) / most) ** (1 / len(long))
    cells = [max(1, int(n / factor)) if n > 1 else 1 for n in cells]
    text = ",".join(map(str, cells))
    return ["--set", f"Grid/Level/Box/resolution=[{text}]"], cells


def short_name(suite, path):
    return path.relative_to(suite).as_posix().removeprefix("inputs/")
