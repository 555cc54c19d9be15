"""Archives in Uintah's raw layout: what archive.Archive reads them with.

The same as `sluice` does: interior values only, particles in the order of patches. The layout is
described in docs/archive_format.md.
"""
import itertools
import re
import struct
import zlib

import numpy as np

from sluice_tools.archive import (CENTRINGS, ArchiveError, Level, Step, Variable, _parse, _triple)

# Element types: code of NumPy, components.
ELEMENTS = {"double": ("f8", 1), "float": ("f4", 1), "int": ("i4", 1), "short int": ("i2", 1),
            "bool": ("u1", 1), "uchar": ("u1", 1), "long64": ("i8", 1), "Point": ("f8", 3),
            "Vector": ("f8", 3), "IntVector": ("i4", 3), "Matrix3": ("f8", 9)}
# Directions in which the variables of a kind close their patch with one more layer.
CLOSING = {"CCVariable": (), "NCVariable": (0, 1, 2), "SFCXVariable": (0,), "SFCYVariable": (1,),
           "SFCZVariable": (2,), "ParticleVariable": ()}


def split_type(text):
    """Kind and element type of "CCVariable<double>"; None where it is not read."""
    match = re.fullmatch(r"\s*(\w+)\s*<\s*([\w ]+?)\s*>\s*", text)
    if match is None or match[1] not in CLOSING or match[2] not in ELEMENTS:
        return None
    return match[1], match[2]


def variables_of(root):
    """What an index names, but for types that are not read."""
    found = {}
    for e in root.iterfind("variables/variable"):
        kinds = split_type(e.get("type"))
        if kinds is not None:
            found[e.get("name")] = Variable(e.get("name"), CENTRINGS[kinds[0]],
                                            ELEMENTS[kinds[1]][1], "",
                                            int(e.get("numMaterials", "1")))
    return found


def byte_order(root, fallback="<"):
    text = (root.findtext("Meta/endianness") or "").strip()
    return {"little_endian": "<", "big_endian": ">", "": fallback}[text]


class Patch:
    def __init__(self, element):
        self.id = int(element.findtext("id"))
        self.outer = (_triple(element.findtext("lowIndex"), int),
                      _triple(element.findtext("highIndex"), int))
        low, high = element.findtext("interiorLowIndex"), element.findtext("interiorHighIndex")
        self.interior = (_triple(low, int) if low else self.outer[0],
                         _triple(high, int) if high else self.outer[1])
        self.open = [[True] * 3, [True] * 3]  # sides without a neighbour: low, high


def _find_open_sides(patches, domain, periodic):
    ends = {}
    for patch, side, d in itertools.product(patches, (0, 1), range(3)):
        ends.setdefault((side, d, patch.interior[side][d]), []).append(patch)

    def overlap(a, b, d):
        return all(e == d or (a.interior[0][e] < b.interior[1][e] and
                              b.interior[0][e] < a.interior[1][e]) for e in range(3))

    for patch, side, d in itertools.product(patches, (0, 1), range(3)):
        edge = patch.interior[side][d]
        edges = [edge]
        if periodic[d] and edge == domain[side][d]:
            edges.append(domain[1 - side][d])
        patch.open[side][d] = not any(overlap(patch, other, d) for place in edges
                                      for other in ends.get((1 - side, d, place), ()))


def _read_grid(path, root):
    beside = path.parent / "grid.xml"
    if not beside.exists():
        return root.find("Grid")
    if not beside.read_bytes().lstrip().startswith(b"<"):
        raise ArchiveError(f"{beside}: is binary, which only the command sluice reads; "
                           "sluice export writes files that other programs read")
    return _parse(beside)


def _levels_of(grid):
    levels, patches = [], []
    for number, e in enumerate(grid.iterfind("Level")):
        spacing = _triple(e.findtext("cellspacing"))
        of_level = [Patch(p) for p in e.iterfind("Patch")]
        lower = tuple(min(p.interior[0][d] for p in of_level) for d in range(3))
        upper = tuple(max(p.interior[1][d] for p in of_level) for d in range(3))
        ratio = (1, 1, 1)
        if levels:
            coarse = levels[-1]
            ratio = tuple(round(coarse.spacing[d] / spacing[d]) for d in range(3))
            lower = tuple(min(lower[d], coarse.lower[d] * ratio[d]) for d in range(3))
            upper = tuple(max(upper[d], coarse.upper[d] * ratio[d]) for d in range(3))
        extent = levels[0] if levels else None
        active = extent.active if extent else tuple(int(upper[d] - lower[d] > 1) for d in range(3))
        _find_open_sides(of_level, (lower, upper),
                         _triple(e.findtext("periodic", "[0, 0, 0]"), int))
        levels.append(Level(number, _triple(e.findtext("anchor")), spacing, ratio, lower, upper,
                            active, tuple(p.interior for p in of_level)))
        patches.append(of_level)
    return levels, patches


class RawStep(Step):
    """A step of a raw archive, with the functions of archive.Step."""

    def __init__(self, archive, number, time, path):
        self.archive, self.number, self.time, self.path = archive, number, time, path
        root = _parse(path)
        self._order = byte_order(root, archive.order)
        self._word = "I" if (root.findtext("Meta/nBits") or "64").strip() == "32" else "Q"
        self.levels, self._patches = _levels_of(_read_grid(path, root))
        beside = path.parent / "data.xml"
        data = _parse(beside) if beside.exists() else root.find("Data")
        self._stored = {}
        for e in data.iterfind("Datafile"):
            level = re.match(r"l(\d+)/", e.get("href"))
            if level:
                self._collect_blocks(path.parent / e.get("href"), int(level[1]))
        for blocks in self._stored.values():
            blocks.sort(key=lambda block: block[0])

    def _collect_blocks(self, record, level):
        places = {patch.id: n for n, patch in enumerate(self._patches[level])}
        for e in _parse(record).iterfind("Variable"):
            if split_type(e.get("type")) is None:
                continue
            name = e.findtext("variable").strip()
            name = "p.x" if name == self.archive.position_name else name
            patch = int(e.findtext("patch") or e.findtext("region"))
            if patch not in places:
                raise ArchiveError(f"{record}: {name} is on patch {patch}, which the grid does not "
                                   "have")
            blocks = self._stored.setdefault((name, int(e.findtext("index")), level), [])
            if all(place != places[patch] for place, *_ in blocks):
                blocks.append((places[patch], record, e))

    def pieces(self, name, material, level):
        """What is stored, patch by patch: [(lower, upper, values[component, i, j, k])]."""
        return [self._read_block(level, place, record, e)
                for place, record, e in self._stored.get((name, material, level), ())]

    def _read_block(self, level, place, record, element):
        kind, value = split_type(element.get("type"))
        code, components = ELEMENTS[value]
        patch = self._patches[level][place]
        values = np.frombuffer(self._bytes(record, element), self._order + code)
        if kind == "ParticleVariable":
            count = int(element.findtext("numParticles") or len(values) // components)
            shape, low, own = (count, 1, 1), (0, 0, 0), ((0, 0, 0), (count, 1, 1))
        else:
            low, high, own = _windows(patch, kind, element.findtext("boundaryLayer"))
            shape = tuple(high[d] - low[d] for d in range(3))
        if len(values) != components * shape[0] * shape[1] * shape[2]:
            raise ArchiveError(f"{record}: {element.findtext('variable').strip()} of patch "
                               f"{patch.id} has {len(values)} numbers in place of "
                               f"{components} times {shape}")
        block = values.reshape((*shape[::-1], components)).transpose(3, 2, 1, 0)
        window = tuple(slice(own[0][d] - low[d], own[1][d] - low[d]) for d in range(3))
        # Particle numbers keep all their bits.
        block = block[(slice(None), *window)]
        return *own, (block if code == "i8" else block.astype(float))

    def _bytes(self, record, element):
        path = record.parent / element.findtext("filename").strip()
        begin, end = int(element.findtext("start")), int(element.findtext("end"))
        try:
            with open(path, "rb") as file:
                file.seek(begin)
                stored = file.read(end - begin)
        except OSError as error:
            raise ArchiveError(f"{path}: {error.strerror}") from error
        if len(stored) < end - begin:
            raise ArchiveError(f"{path}: ends at {begin + len(stored)} bytes, a block reaches to "
                               f"{end}")
        if (element.findtext("compression") or "").strip() != "gzip":
            return stored
        head = struct.calcsize(self._order + self._word)
        try:
            length, = struct.unpack(self._order + self._word, stored[:head])
            inflated = zlib.decompress(stored[head:])
        except (struct.error, zlib.error) as error:
            raise ArchiveError(f"{path}: a block cannot be inflated ({error})") from error
        if len(inflated) != length:
            raise ArchiveError(f"{path}: {len(inflated)} bytes inflated in place of {length}")
        return inflated


def _windows(patch, kind, layers):
    """Stored low and high index of a block, and the box of indices that are of this patch alone."""
    low, high = list(patch.outer[0]), list(patch.outer[1])
    layers = _triple(layers, int) if layers else (0, 0, 0)
    if any(layers):
        low = [patch.interior[0][d] - patch.open[0][d] * layers[d] for d in range(3)]
        high = [patch.interior[1][d] + patch.open[1][d] * layers[d] for d in range(3)]
    own = [list(patch.interior[0]), list(patch.interior[1])]
    for d in CLOSING[kind]:
        high[d] += patch.open[1][d]
        own[1][d] += patch.open[1][d]
    return tuple(low), tuple(high), (tuple(own[0]), tuple(own[1]))
