"""Read an archive: steps, levels and fields as NumPy arrays.

    archive = Archive("shock_tube.uda")
    step = archive.step("last")
    density = step.field("rho_CC")           # Field of level 0, material 0
    density.values                           # array [i, j, k], vectors [component, i, j, k]
    density.coordinates(0)                   # positions along x
    step.particles()["p.x"]                  # particles by id: arrays [n], vectors [n, component]
    step.particles(1, {"p.stress"})          # of material 1, one variable: tensors [n, 9]

Archives in Uintah's raw layout are read in the same way, see raw_archive.py. The layouts are
described in docs/archive_format.md. Checksums are not verified here: `sluice info
--verify` does that.
"""
import dataclasses
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy as np

CENTRINGS = {"CCVariable": "cell", "NCVariable": "node", "SFCXVariable": "x face",
             "SFCYVariable": "y face", "SFCZVariable": "z face",
             "ParticleVariable": "particle", "ReductionVariable": "reduction"}


TENSOR = ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")  # components in order


class ArchiveError(Exception):
    """What is asked for is not there, or not readable; the message says what to try."""


def _triple(text, kind=float):
    return tuple(kind(part) for part in text.strip().strip("[]").split(","))


def _parse(path):
    try:
        return ElementTree.parse(path).getroot()
    except OSError as error:
        raise ArchiveError(f"{path}: {error.strerror}: is this an archive?") from error
    except ElementTree.ParseError as error:
        raise ArchiveError(f"{path}: not readable as XML ({error})") from error


@dataclasses.dataclass(frozen=True)
class Variable:
    name: str
    centring: str
    components: int
    unit: str
    materials: int


@dataclasses.dataclass(frozen=True)
class Level:
    index: int
    anchor: tuple
    spacing: tuple
    ratio: tuple  # cells of this level along one of the next coarser
    lower: tuple  # of the domain, in cells
    upper: tuple
    active: tuple
    boxes: tuple  # ((lower), (upper)) a box

    def active_directions(self):
        found = [d for d in range(3) if self.active[d] and self.upper[d] - self.lower[d] > 1]
        return found or [max(range(3), key=lambda d: self.upper[d] - self.lower[d])]

    def edges(self, box):
        """Physical low and high corner of a box of cells."""
        low, high = box
        return ([self.anchor[d] + low[d] * self.spacing[d] for d in range(3)],
                [self.anchor[d] + high[d] * self.spacing[d] for d in range(3)])


@dataclasses.dataclass
class Field:
    variable: Variable
    material: int
    level: Level
    lower: tuple
    values: np.ndarray  # [i, j, k] or [component, i, j, k]; NaN where no box lies

    def coordinates(self, direction):
        count = self.values.shape[direction - 3]
        faces = self.variable.centring == "node" or self.variable.centring[0] == "xyz"[direction]
        shift = 0.0 if faces and self.variable.centring != "cell" else 0.5
        index = self.lower[direction] + np.arange(count) + shift
        return self.level.anchor[direction] + index * self.level.spacing[direction]


class Archive:
    def __init__(self, path):
        self.path = pathlib.Path(path).resolve()
        root = _parse(self.path / "index.xml")
        stored = root.findtext("outputFormat", default="UDA").strip()
        if stored not in ("HDF5", "UDA"):
            raise ArchiveError(f"{path}: the archive's format is '{stored}'; HDF5 and UDA are read")
        self.raw = stored == "UDA"
        self.steps = [(int(e.text), float(e.get("time")), self.path / e.get("href"))
                      for e in root.iterfind("timesteps/timestep")]
        if self.raw:
            from sluice_tools import raw_archive  # which needs this module
            self.order = raw_archive.byte_order(root)
            self.position_name = (root.findtext("ParticlePosition") or "p.x").strip()
            self.variables = raw_archive.variables_of(root)
            self._step = raw_archive.RawStep
        else:
            self.variables = {e.get("name"): _variable(e)
                              for e in root.iterfind("variables/variable")}
            self._step = Step
        self.histories = {e.get("name"): (self.path / e.get("href"), e.get("type", ""))
                          for e in root.iterfind("globals/variable") if e.get("href")}

    def title(self):
        """What the deck calls itself, or the name of the archive."""
        name = self.path.name.split(".uda")[0].replace("_", " ")
        try:
            deck = ElementTree.parse(self.path / "input.xml").getroot()
        except (OSError, ElementTree.ParseError):
            return name
        return " ".join((deck.findtext("Meta/title") or name).split())

    def step(self, which="last"):
        """'last', 'first', '#N' (N-th output from 0), or a time: the nearest output."""
        if not self.steps:
            raise ArchiveError(f"{self.path}: the archive holds no output yet")
        return self._step(self, *self.steps[self._position(str(which))])

    def _position(self, which):
        if which in ("last", "first"):
            return -1 if which == "last" else 0
        try:
            if which.startswith("#"):
                number = int(which[1:])
                if not 0 <= number < len(self.steps):
                    raise ArchiveError(f"there is no output {which}: #0 to #{len(self.steps) - 1}")
                return number
            return self._nearest(float(which))
        except ValueError as error:
            raise ArchiveError(f"'{which}' is no time: give last, first, #N or a number") from error

    def _nearest(self, wanted):
        times = [time for _, time, _ in self.steps]
        best = min(range(len(times)), key=lambda n: abs(times[n] - wanted))
        gaps = [b - a for a, b in zip(times, times[1:])]
        near = gaps[max(0, best - 1):best + 1] or [abs(times[0])]
        if abs(times[best] - wanted) > 0.5 * max(near) * (1 + 1e-9):
            raise ArchiveError(f"no output near time {wanted:g}: they go from {times[0]:g} to "
                               f"{times[-1]:g}")
        return best

    def level_cells(self):
        """What levels.txt holds: rows of step, time, cells of level 0, of level 1, ..."""
        path = self.path / "levels.txt"
        if not path.exists():
            raise ArchiveError(f"{self.path.name} holds no levels.txt: its run had one level")
        try:
            return np.loadtxt(path, ndmin=2)
        except ValueError as error:
            raise ArchiveError(f"{path}: not readable as a table ({error})") from error

    def history(self, name):
        """A .dat file: (what the lines go by, its numbers, values [line, component])."""
        if name not in self.histories:
            raise ArchiveError(f"no history '{name}'; there are: {_names(self.histories)}")
        path, kind = self.histories[name]
        try:
            lines = np.loadtxt(path, ndmin=2)
        except (OSError, ValueError) as error:
            raise ArchiveError(f"{path}: not readable as a history ({error})") from error
        width = 3 if "Vector" in kind else 1
        before, values = lines[:, :-width], lines[:, -width:]
        # A step number and the time may stand before the values, or one, or neither.
        if before.shape[1] == 0:
            return "line", np.arange(1, len(lines) + 1), values
        times = before[:, -1]
        steps = before.shape[1] == 1 and np.array_equal(times, np.floor(times)) and times[0] >= 1
        return "step" if steps else "time", times, values


def _variable(element):
    kind, value = element.get("type").rstrip(">").split("<")
    components = {"Vector": 3, "Point": 3, "Matrix3": 9}.get(value, 1)
    return Variable(element.get("name"), CENTRINGS[kind], components, element.get("unit") or "",
                    int(element.get("numMaterials", "1")))


def _names(known):
    return ", ".join(sorted(known)) or "none"


class Step:
    def __init__(self, archive, number, time, path):
        self.archive, self.number, self.time, self.path = archive, number, time, path
        root = _parse(path)
        self.levels = [_level(e) for e in root.iterfind("Grid/Level")]
        records = [path.parent / e.get("href") for e in root.iterfind("Data/Datafile")]
        self._stored = {}
        for record in records:
            self._collect(record)

    def _collect(self, record):
        root = _parse(record)
        data = record.parent / root.find("Datafile").get("href")
        for e in root.iterfind("Variable"):
            key = (e.get("name"), int(e.get("material")), int(e.get("level")))
            self._stored.setdefault(key, []).append((data, e.get("group")))

    def has(self, name):
        return any(key[0] == name for key in self._stored)

    def names(self):
        return sorted({key[0] for key in self._stored})

    def materials(self, name):
        return sorted({key[1] for key in self._stored if key[0] == name})

    def stored(self):
        """All (name, material, level) of this step."""
        return sorted(self._stored)

    def particle_materials(self):
        return self.materials("p.x")

    def particles(self, material=None, wanted=None):
        """Variables of all particles of a material (all, or those whose names are wanted), on all
        levels, in the order of their ids: arrays [n], vectors [n, 3], tensors [n, 9]. A raw archive
        may hold no ids: its particles are then in the order of its patches."""
        there = self.particle_materials()
        if not there:
            raise ArchiveError(f"no particles at step {self.number}; save p.x")
        material = there[0] if material is None else material
        if material not in there:
            raise ArchiveError(f"no particles of material {material}; materials: {there}")
        kinds = self.archive.variables
        names = [n for n in self.names()
                 if kinds[n].centring == "particle" and material in self.materials(n)
                 and (wanted is None or n in wanted or n == "p.particleID")]
        levels = sorted({key[2] for key in self._stored if key[:2] == ("p.x", material)})
        table = {}
        for name in names:
            lists = [block[:, :, 0, 0].T for level in levels
                     for _, _, block in self.pieces(name, material, level)]
            values = np.concatenate(lists)
            table[name] = values if kinds[name].components > 1 else values[:, 0]
        if "p.particleID" not in table:  # of raw archives that save none: in stored order
            return table
        order = np.argsort(table["p.particleID"])
        return {name: values[order] for name, values in table.items()}

    def pieces(self, name, material, level):
        """What is stored, box by box: [(lower, upper, values[component, i, j, k])]."""
        return [part for data, group in self._stored.get((name, material, level), ())
                for part in _read_group(data, group)]

    def field(self, name, material=None, level=0):
        if not self.has(name):
            raise ArchiveError(f"no variable '{name}' at step {self.number}; there are: "
                               f"{_names(self.names())}")
        if material is None:
            material = self.materials(name)[0]
        parts = self.pieces(name, material, level)
        if not parts:
            raise ArchiveError(f"'{name}' is not stored for material {material} on level {level}; "
                               f"materials: {self.materials(name)}")
        variable = self.archive.variables.get(name)
        lower = tuple(min(p[0][d] for p in parts) for d in range(3))
        upper = tuple(max(p[1][d] for p in parts) for d in range(3))
        shape = tuple(upper[d] - lower[d] for d in range(3))
        several = variable.components > 1
        values = np.full(((variable.components,) if several else ()) + shape, np.nan)
        for low, high, block in parts:
            window = tuple(slice(low[d] - lower[d], high[d] - lower[d]) for d in range(3))
            values[(..., *window)] = block if several else block[0]
        return Field(variable, material, self.levels[level], lower, values)


def _read_group(data, group):
    """The boxes of one group of a data file: (lower, upper, [component, i, j, k])."""
    import h5py  # here, so that listing an archive needs no HDF5
    try:
        with h5py.File(data, "r") as file:
            boxes = file[group]["boxes"][()]
            values = file[group]["values"][()]
            components = file[group]["crc32c"].shape[1]
    except (OSError, KeyError) as error:
        raise ArchiveError(f"{data}: {group} cannot be read ({error})") from error
    at = 0
    for box in boxes:
        low, high = tuple(int(n) for n in box[:3]), tuple(int(n) for n in box[3:])
        shape = tuple(high[d] - low[d] for d in range(3))
        size = components * shape[0] * shape[1] * shape[2]
        # Stored x fastest, component after component.
        block = values[at:at + size].reshape((components, shape[2], shape[1], shape[0]))
        yield low, high, block.transpose(0, 3, 2, 1)
        at += size


def _level(e):
    boxes = tuple((_triple(p.findtext("lowIndex"), int), _triple(p.findtext("highIndex"), int))
                  for p in e.iterfind("Patch"))
    return Level(int(e.findtext("id")), _triple(e.findtext("anchor")),
                 _triple(e.findtext("cellspacing")), _triple(e.findtext("refinementRatio"), int),
                 _triple(e.findtext("domainLow"), int), _triple(e.findtext("domainHigh"), int),
                 _triple(e.findtext("active"), int), boxes)
