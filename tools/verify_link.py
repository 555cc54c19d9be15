#!/usr/bin/python3
"""Reads an archive through its fields.xmf and compares every number with the archive itself.

usage: verify_link.py ARCHIVE [--paraview]

Without --paraview the ranges that fields.xmf names are read by h5py; with it ParaView opens the
file, and what it draws and integrates is checked as well. The archive is read by sluice_tools from
its documented layout. Exit status: 0 all numbers are equal to the bit, 1 one is not, 77 h5py or
ParaView is not installed.
"""

import pathlib
import sys
import xml.etree.ElementTree as xml

SKIPPED = 77

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"verify_link: skipped: {missing}")
    sys.exit(SKIPPED)

from sluice_tools import materials
from sluice_tools.archive import Archive, ArchiveError

COVERED = 9  # of vtkGhostType: refined, and a duplicate


class Image:
    """A box as a reader shows it: arrays [z, y, x] or [z, y, x, component]."""

    def __init__(self, level, origin, spacing, counts, arrays):
        self.level, self.arrays = level, arrays
        self.origin, self.spacing, self.counts = (np.array(v) for v in (origin, spacing, counts))


class Shown:
    """One output: images, and of each material the arrays of its particles."""

    def __init__(self, time):
        self.time, self.images, self.points = time, [], {}

    def add_points(self, material, arrays):
        for name, values in arrays.items():
            self.points.setdefault(material, {}).setdefault(name, []).append(values)


# What the XML itself says, read by h5py.

def numbers(text, kind=int):
    return [kind(word) for word in text.split()]


def values_of(item, folder, files):
    dims = numbers(item.get("Dimensions"))
    kind = item.get("ItemType")
    if kind == "Function":
        parts = item.findall("DataItem")
        if item.get("Function") != f"JOIN({','.join(f'${n}' for n in range(len(parts)))})":
            raise AssertionError(f"an unknown function {item.get('Function')}")
        return np.stack([values_of(p, folder, files) for p in parts], -1).reshape(dims)
    if kind != "HyperSlab":
        raise AssertionError(f"an item of type {kind}")
    places, whole = item.findall("DataItem")
    start, stride, count = numbers(places.text)
    name, key = whole.text.split(":")
    if name not in files:
        files[name] = h5py.File(folder / name, "r")
    data = files[name][key]
    code = {"Float": "f", "Int": "i", "UChar": "u"}[whole.get("NumberType", "Float")]
    if data.dtype != np.dtype(f"{code}{whole.get('Precision', '4')}") or stride != 1:
        raise AssertionError(f"{whole.text} is of {data.dtype}, not as fields.xmf says")
    if list(data.shape) != numbers(whole.get("Dimensions")) or start + count > data.size:
        raise AssertionError(f"{whole.text} has {data.shape} values, not as fields.xmf says")
    return data[start:start + count].reshape(dims)


def arrays_of(grid, folder, files):
    return {a.get("Name"): values_of(a.find("DataItem"), folder, files)
            for a in grid.findall("Attribute")}


def shown_by_xml(path):
    files = {}
    outputs = xml.parse(path).getroot().find("Domain/Grid").findall("Grid")
    for output in outputs:
        shown = Shown(float(output.find("Time").get("Value")))
        for part in output.findall("Grid"):
            kind, name = part.get("Name").split(" ", 1)
            for grid in part.findall("Grid"):
                arrays = arrays_of(grid, path.parent, files)
                items = grid.findall("Geometry/DataItem")
                if kind == "level":
                    counts = numbers(grid.find("Topology").get("Dimensions"))
                    origin, spacing = (numbers(i.text, float)[::-1] for i in items)
                    shown.images.append(Image(int(name), origin, spacing,
                                              [n - 1 for n in counts[::-1]], arrays))
                else:
                    arrays["p.x"] = np.stack([values_of(i, path.parent, files) for i in items], -1)
                    shown.add_points(name.split(" ", 1)[1], arrays)
        yield shown


# What ParaView makes of it.

def shown_by_paraview(path):
    from paraview import servermanager, simple
    reader = simple.XDMFReader(FileNames=[str(path)])
    reader.UpdatePipelineInformation()
    for time in np.array(reader.TimestepValues, ndmin=1):
        reader.UpdatePipeline(time)
        shown = Shown(float(time))
        data = servermanager.Fetch(reader)
        for name, part in blocks_of(data):
            kind, name = name.split(" ", 1)
            for _, grid in blocks_of(part):
                add_block(shown, kind, name, grid)
        levels = len({image.level for image in shown.images})
        shown.integrals = integrals(simple, reader, levels, time) if levels else {}
        yield shown


def blocks_of(data):
    for n in range(data.GetNumberOfBlocks()):
        yield data.GetMetaData(n).Get(data.NAME()), data.GetBlock(n)


def add_block(shown, kind, name, grid):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    data = grid.GetCellData() if kind == "level" else grid.GetPointData()
    arrays = {data.GetArray(n).GetName(): vtk_to_numpy(data.GetArray(n))
              for n in range(data.GetNumberOfArrays())}
    if kind == "level":
        counts = np.array(grid.GetDimensions()) - 1
        arrays = {name: a.reshape((*counts[::-1], *a.shape[1:])) for name, a in arrays.items()}
        shown.images.append(Image(int(name), grid.GetOrigin(), grid.GetSpacing(), counts, arrays))
    else:
        if grid.GetNumberOfCells() != grid.GetNumberOfPoints():
            raise AssertionError("not every particle is drawn")
        arrays["p.x"] = vtk_to_numpy(grid.GetPoints().GetData())
        shown.add_points(name.split(" ", 1)[1], arrays)


def integrals(simple, reader, levels, time):
    """{array: integral, "Volume": ...} of the images."""
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy
    images = simple.ExtractBlock(Input=reader)
    images.Selectors = [f"/Root/level{n}" for n in range(levels)]
    total = simple.IntegrateVariables(Input=images)
    total.UpdatePipeline(time)
    data = servermanager.Fetch(total).GetCellData()
    return {data.GetArray(n).GetName(): vtk_to_numpy(data.GetArray(n))[0]
            for n in range(data.GetNumberOfArrays())}


# The comparison.

def covered_cells(level, finer):
    """Marks [z, y, x] over the domain of a level."""
    shape = np.array(level.upper) - level.lower
    marks = np.zeros(shape[::-1], np.uint8)
    for low, high in finer.boxes if finer else ():
        low, high = (np.array(c) // finer.ratio - level.lower for c in (low, high))
        marks[tuple(slice(low[d], high[d]) for d in (2, 1, 0))] = COVERED
    return marks


def same(name, mine, theirs):
    if mine.shape != theirs.shape or mine.dtype != theirs.dtype:
        raise AssertionError(f"{name}: {theirs.dtype} {theirs.shape}, the archive has "
                             f"{mine.dtype} {mine.shape}")
    if mine.tobytes() != np.ascontiguousarray(theirs).tobytes():
        raise AssertionError(f"values of {name} differ")
    return mine.size


def name_of(archive, label, material):
    names = materials.names(archive)
    several = archive.variables[label].materials > 1
    told = names[material].removeprefix("material ")
    return f"{label}_{told}" if several else label


def expected_boxes(step, level):
    """{lower corner: {array: values}} of a level."""
    boxes = {}
    for label, material, at in step.stored():
        if at != level.index or step.archive.variables[label].centring != "cell":
            continue
        for low, _, block in step.pieces(label, material, at):
            values = np.ascontiguousarray(block.transpose(3, 2, 1, 0))
            values = values[..., 0] if values.shape[-1] == 1 else values
            boxes.setdefault(low, {})[name_of(step.archive, label, material)] = values
    return boxes


def compare_images(step, shown):
    compared = 0
    for number, level in enumerate(step.levels):
        finer = step.levels[number + 1] if number + 1 < len(step.levels) else None
        marks = covered_cells(level, finer)
        boxes = expected_boxes(step, level)
        images = [image for image in shown.images if image.level == number]
        if len(images) != len(boxes):
            raise AssertionError(f"level {number}: {len(images)} images of {len(boxes)} boxes")
        for image in images:
            corner = (image.origin - level.anchor) / level.spacing
            low = tuple(int(n) for n in np.round(corner))
            if (not np.allclose(corner, low, atol=1e-9)
                    or not np.array_equal(image.spacing, level.spacing)):
                raise AssertionError(f"an image at {image.origin}, off the cells of its level")
            mine, theirs = boxes.pop(low), dict(image.arrays)
            window = tuple(slice(low[d] - level.lower[d], low[d] - level.lower[d]
                                 + image.counts[d]) for d in (2, 1, 0))
            ghosts = theirs.pop("vtkGhostType", np.zeros(image.counts[::-1], np.uint8))
            compared += same("vtkGhostType", np.ascontiguousarray(marks[window]), ghosts)
            if sorted(mine) != sorted(theirs):
                raise AssertionError(f"arrays {sorted(theirs)}, not {sorted(mine)}")
            compared += sum(same(name, mine[name], theirs[name]) for name in mine)
    return compared


def compare_points(step, shown):
    compared = 0
    names = materials.names(step.archive)
    there = {names[m]: m for m in step.particle_materials()}
    if sorted(there) != sorted(shown.points):
        raise AssertionError(f"particles of {sorted(shown.points)}, not of {sorted(there)}")
    for name, material in there.items():
        mine = step.particles(material)
        theirs = {label: np.concatenate(parts) for label, parts in shown.points[name].items()}
        ids = name_of(step.archive, "p.particleID", material)
        order = np.argsort(theirs[ids])
        for label, values in mine.items():
            array = label if label == "p.x" else name_of(step.archive, label, material)
            compared += same(label, values, theirs.pop(array)[order])
        if theirs:
            raise AssertionError(f"arrays that the archive does not have: {sorted(theirs)}")
    return compared


def check_integrals(step, shown):
    """Each place counts once: on the finest level that covers it."""
    volume, sums = 0.0, {}
    for number, level in enumerate(step.levels):
        finer = step.levels[number + 1] if number + 1 < len(step.levels) else None
        seen = covered_cells(level, finer) == 0
        cell = float(np.prod(level.spacing))
        for low, arrays in expected_boxes(step, level).items():
            shape = next(iter(arrays.values())).shape[:3]
            window = tuple(slice(low[d] - level.lower[d], low[d] - level.lower[d]
                                 + shape[2 - d]) for d in (2, 1, 0))
            volume += cell * np.count_nonzero(seen[window])
            for name, values in arrays.items():
                part = cell * values[seen[window]].astype(float).sum(axis=0)
                sums[name] = sums.get(name, 0.0) + part
    found = dict(shown.integrals)
    if not np.isclose(found.pop("Volume"), volume, rtol=1e-12):
        raise AssertionError(f"ParaView integrates {shown.integrals['Volume']} m^3, not {volume}")
    for name, expected in sums.items():
        scale = np.abs(expected).max() + 1e-300
        if np.isfinite(scale) and not np.allclose(found[name], expected, rtol=1e-9,
                                                  atol=1e-9 * scale):
            raise AssertionError(f"ParaView integrates {name} to {found[name]}, not {expected}")


def size_of(files):
    return sum(f.stat().st_size for f in files if f.is_file())


def main(path, *options):
    archive = Archive(path)
    link = archive.path / "fields.xmf"
    reader = shown_by_paraview if "--paraview" in options else shown_by_xml
    compared = count = 0
    for count, shown in enumerate(reader(link), 1):
        step = archive.step(f"#{count - 1}")
        if shown.time != step.time:
            raise AssertionError(f"output {count - 1} at {shown.time}, not at {step.time}")
        compared += compare_images(step, shown) + compare_points(step, shown)
        if "--paraview" in options and shown.images:
            check_integrals(step, shown)
    if count != len(archive.steps) or compared == 0:
        raise AssertionError(f"{count} outputs, the archive has {len(archive.steps)}")
    own = size_of(archive.path.glob("fields*"))
    whole = size_of(archive.path.rglob("*")) - own
    print(f"verify_link: {compared} values in {count} outputs are equal; the link takes "
          f"{100 * own / whole:.1f} % of the archive's {whole} bytes")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (AssertionError, ArchiveError) as difference:
        print(f"verify_link: WRONG: {difference}")
        sys.exit(1)
