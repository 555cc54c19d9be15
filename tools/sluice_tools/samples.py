"""What a run has written as text beside its fields: histories, and the samples of <DataAnalysis>.

    catalogue(archive)                 # {name: Sample}, as `sluice info` lists them
    read(sample)                       # Table of all its lines
    read(sample, time=1e-3)            # of a snapshot (plane, average): the nearest time

A sample is one of KINDS; the files lie as docs/analysis.md tells. Columns have the names of the
header line; of a history (without a header) value, or x, y, z.
"""
import dataclasses
import pathlib
import re

import numpy as np

from .archive import ArchiveError

KINDS = {"history": "one line a step", "extremes": "least and largest values over time",
         "probe": "values at a point over time", "budget": "amounts and fluxes over time",
         "particle": "one particle over time", "line": "cells of a line, at several times",
         "plane": "cells of a plane, at several times",
         "average": "averages over planes, at several times"}
# Of the columns of budgets, docs/analysis.md.
UNITS = {"Total": "kg", "CV_mom": "kg m/s", "total_ICE_Flux": "W", "forcePower": "W",
         **dict.fromkeys(("X_faces", "Y_faces", "Z_faces", "x-", "x+", "y-", "y+", "z-", "z+"),
                         "kg/s"),
         **dict.fromkeys(("momFlux", "visFlux", "pressForce", "bodyForce"), "N"),
         **dict.fromkeys(("ICE_totalIntEng", "MPM_totalIntEng", "totalIntEng", "kinEng"), "J")}
SNAPSHOT = re.compile(r"t\d{5,}")
CELL = re.compile(r"i-?\d+_j-?\d+_k-?\d+")


@dataclasses.dataclass
class Sample:
    name: str
    kind: str
    files: list  # of a line one a cell, of snapshots one a time, else one
    vector: bool = False  # of a history


@dataclasses.dataclass
class Table:
    columns: list
    rows: np.ndarray  # [line, column]
    time: float = float("nan")  # of a snapshot

    def column(self, name):
        return self.rows[:, self.columns.index(name)]


def _begins_with_hash(path):
    try:
        with open(path, "rb") as file:
            return file.read(1) == b"#"
    except OSError:
        return False


def _kind_of(parts):
    head = parts[0]
    if head == "MinMax":
        return "extremes"
    if head == "points":
        return "probe"
    if head == "particleExtract":
        return "particle"
    if head in ("planeAverage", "planarAveTurbFluxes"):
        return "average"
    if any(SNAPSHOT.fullmatch(part) for part in parts):
        return "plane"
    return "line" if CELL.fullmatch(parts[-1]) else "budget"


def _name_of(kind, parts):
    """Without what differs between the files of one sample."""
    last = pathlib.PurePath(parts[-1])
    parts = [*parts[:-1], last.stem if last.suffix == ".dat" else last.name]
    if kind == "line":
        parts = parts[:-1]
    return "/".join(part for part in parts if not SNAPSHOT.fullmatch(part))


def catalogue(archive):
    """{name: Sample} of all that is there, histories first."""
    found = {name: Sample(name, "history", [path], "Vector" in kind)
             for name, (path, kind) in archive.histories.items()}
    for path in sorted(archive.path.rglob("*")):
        parts = path.relative_to(archive.path).parts
        outside = SNAPSHOT.fullmatch(parts[0]) or parts[0] in ("checkpoints", "input_files")
        if outside or path.name == "levels.txt" or not path.is_file():
            continue
        if not _begins_with_hash(path):
            continue
        kind = _kind_of(parts)
        name = _name_of(kind, parts)
        found.setdefault(name, Sample(name, kind, [])).files.append(path)
    return found


def find(archive, name):
    known = catalogue(archive)
    if name not in known:
        import difflib
        near = difflib.get_close_matches(name, known, 1)
        raise ArchiveError(f"no history or sample '{name}' in {archive.path.name}" +
                           (f"; did you mean '{near[0]}'?" if near else "") +
                           "; there are: " + (", ".join(known) or "none"))
    return known[name]


def _lines(path):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ArchiveError(f"{path}: not readable ({error})") from error


def _numbers(path, lines):
    """Rows of numbers; brackets and commas count as blanks."""
    rows = [re.sub(r"[\[\],\t]", " ", line).split() for line in lines if line[:1] != "#"]
    rows = [row for row in rows if row]
    try:
        return np.array([[float(word) for word in row] for row in rows]).reshape(len(rows), -1)
    except ValueError as error:
        raise ArchiveError(f"{path}: not readable as a table ({error})") from error


def _columns(kind, header, width):
    """Names of the columns from the last header line that has as many words as a line."""
    if kind == "extremes":
        count = (width - 1) // 2
        ends = [""] if count == 1 else [f".{c}" for c in ("xyz" if count == 3 else range(count))]
        return ["Time", *(f"{which}{end}" for which in ("minimum", "maximum") for end in ends)]
    for line in reversed(header):
        words = line.lstrip("#").replace(",", " ").split()
        if kind == "particle":
            words = words[:width]
        if len(words) == width:
            return words
    return ["Time", *(f"column {n}" for n in range(2, width + 1))]


def _history(sample):
    path = sample.files[0]
    rows = _numbers(path, _lines(path))
    width = 3 if sample.vector else 1
    before, names = rows.shape[1] - width, list("xyz") if sample.vector else ["value"]
    if before < 0 or before > 2:
        raise ArchiveError(f"{path}: a line has {rows.shape[1]} numbers; a history has {width} and "
                           "before them a step and a time, or one of them")
    # A step number and the time may stand before the values, or one, or neither.
    if before == 1:
        first = rows[:, 0]
        steps = len(first) and first[0] >= 1 and np.array_equal(first, np.floor(first))
        return Table(["Timestep" if steps else "Time", *names], rows)
    return Table([*(["Timestep", "Time"] if before else []), *names], rows)


def _with_header(kind, path):
    lines = _lines(path)
    header = [line for line in lines if line[:1] == "#"]
    rows = _numbers(path, lines)
    return header, Table(_columns(kind, header, rows.shape[1]), rows)


def times(sample):
    """Of a snapshot: the time of each of its files, s."""
    found = []
    for path in sample.files:
        with open(path, encoding="utf-8") as file:
            word = file.readline().rpartition(":")[2]
        try:
            found.append(float(word))
        except ValueError as error:
            raise ArchiveError(f"{path}: its first line tells no time") from error
    return np.array(found)


def read(sample, time=None):
    """All lines of a sample as a Table; of a plane or an average those of the time nearest to
    `time` (None: of the last)."""
    if sample.kind == "history":
        return _history(sample)
    if sample.kind in ("plane", "average"):
        when = times(sample)
        at = when.argmax() if time is None else np.abs(when - time).argmin()
        table = _with_header(sample.kind, sample.files[at])[1]
        table.time = float(when[at])
        return table
    tables = [_with_header(sample.kind, path)[1] for path in sample.files]
    rows = np.concatenate([table.rows for table in tables])
    if sample.kind == "line":  # by time, then along the line
        keys = [tables[0].columns.index(name) for name in ("Z", "Y", "X", "Time")]
        rows = rows[np.lexsort([rows[:, key] for key in keys])]
    return Table(tables[0].columns, rows)


def unit(sample, column, archive):
    """The unit of a column as far as the archive tells it: of labels that it holds, of extremes."""
    if column in ("X", "Y", "Z"):
        return "m"
    if sample.kind == "extremes":
        found = re.search(r"\[([^\]]*)\], material", _lines(sample.files[0])[0])
        return found.group(1) if found else ""
    if sample.kind == "history":
        return archive.units_of_histories.get(sample.name, "")
    label = column.split(".x")[0].split(".y")[0].split(".z")[0]
    if sample.kind == "budget":
        return UNITS.get(label, "")
    for name in (label, label.rpartition("_")[0]):
        if name in archive.variables:
            return archive.variables[name].unit
    return ""
