#!/usr/bin/python3
"""Reads an export of an archive back with VTK and compares every number with the archive itself.

usage: verify_export.py ARCHIVE EXPORT.pvd [--paraview]

The archive is read with h5py from its documented layout, the export with VTK's own readers (and,
with --paraview, its times with ParaView's). Exit status: 0 all numbers are equal to the bit, 1 one
is not, 77 vtkmodules or h5py is not installed.
"""

import pathlib
import sys
import xml.etree.ElementTree as xml

SKIPPED = 77

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLUniformGridAMRReader
except ImportError as missing:
    print(f"verify_export: skipped: {missing}")
    sys.exit(SKIPPED)


def triple(text):
    return np.array([float(part) for part in text.strip().strip("[]").split(",")])


class Level:
    """Geometry of one level, and its fields as {(label, material): [(lower, array)]}."""

    def __init__(self, element):
        self.anchor = triple(element.findtext("anchor"))
        self.spacing = triple(element.findtext("cellspacing"))
        self.ratio = triple(element.findtext("refinementRatio")).astype(int)
        self.boxes = [(triple(p.findtext("lowIndex")).astype(int),
                       triple(p.findtext("highIndex")).astype(int))
                      for p in element.findall("Patch")]
        self.fields = {}
        self.centring = {}


def read_step(timestep_xml):
    """The levels of one archived step, with all fields."""
    root = xml.parse(timestep_xml).getroot()
    levels = [Level(element) for element in root.find("Grid").findall("Level")]
    for data_file in root.find("Data").findall("Datafile"):
        record = xml.parse(timestep_xml.parent / data_file.get("href")).getroot()
        with h5py.File(timestep_xml.parent / record.find("Datafile").get("href"), "r") as file:
            for variable in record.findall("Variable"):
                read_variable(file[variable.get("group")], variable, levels)
    return levels


def read_variable(group, variable, levels):
    level = levels[int(variable.get("level"))]
    key = (variable.get("name"), int(variable.get("material")))
    level.centring[key] = group.attrs["centring"].decode()
    components = 3 if group.attrs["type"].decode() == "vector" else 1
    values, start = group["values"][:], 0
    for box in group["boxes"][:]:
        lower, upper = box[:3], box[3:]
        shape = (components, *(upper - lower)[::-1])
        count = int(np.prod(shape))
        level.fields.setdefault(key, []).append((lower, values[start:start + count].reshape(shape)))
        start += count


def images_of(path):
    """[(level, image)] of a .vti or .vthb file."""
    if path.suffix == ".vti":
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        return [(0, reader.GetOutput())]
    reader = vtkXMLUniformGridAMRReader()
    reader.SetFileName(str(path))
    reader.SetMaximumLevelsToReadByDefault(0)
    reader.Update()
    amr = reader.GetOutput()
    return [(level, amr.GetDataSet(level, n)) for level in range(amr.GetNumberOfLevels())
            for n in range(amr.GetNumberOfDataSets(level))]


def image_box(level, image):
    """Index box of an image within its level from its own origin, spacing and extent, and into how
    many thin cells each of the level's is cut (one-cell directions of a refined level)."""
    spacing = np.array(image.GetSpacing())
    copies = np.round(level.spacing / spacing).astype(int)
    if np.any(copies < 1) or not np.allclose(spacing * copies, level.spacing, rtol=1e-12):
        raise AssertionError(f"spacing {spacing} is not {level.spacing}")
    extent = np.array(image.GetExtent()).reshape(3, 2)
    corners = (np.array(image.GetOrigin()) - level.anchor) / level.spacing
    corners = corners + extent.T / copies
    if not np.allclose(corners, np.round(corners), atol=1e-9):
        raise AssertionError(f"origin {image.GetOrigin()} is not on the level's corners")
    lower, upper = np.round(corners).astype(int)
    return lower, upper, copies


def one_of_each(found, copies):
    """The array without the copies; all copies must be equal."""
    for axis, count in zip((2, 1, 0), copies):
        parts = [found.take(np.arange(n, found.shape[axis], count), axis) for n in range(count)]
        if not all(np.array_equal(parts[0], part, equal_nan=True) for part in parts):
            raise AssertionError("the thin cells of one cell differ")
        found = parts[0]
    return found


def compare(image, box, array_name, on_points, shift, pieces):
    """Number of values found equal; raises when one is not."""
    data = image.GetPointData() if on_points else image.GetCellData()
    array = data.GetArray(array_name)
    if array is None:
        raise AssertionError(f"the export has no array {array_name}")
    lower, upper = box[0], box[1] + (1 if on_points else 0)
    copies = box[2] if not on_points else np.ones(3, dtype=int)
    shape = (*((upper - lower) * copies)[::-1], array.GetNumberOfComponents())
    found = one_of_each(vtk_to_numpy(array).reshape(shape), copies)
    compared = 0
    for piece_lower, values in pieces:
        piece_lower = piece_lower - shift
        piece_upper = piece_lower + np.array(values.shape[:0:-1])
        low, high = np.maximum(lower, piece_lower), np.minimum(upper, piece_upper)
        if np.any(high <= low):
            continue
        ours = values[(slice(None), *window(low, high, piece_lower))]
        theirs = np.moveaxis(found[window(low, high, lower)], -1, 0)
        if not np.array_equal(ours.astype(theirs.dtype), theirs, equal_nan=True):
            raise AssertionError(f"values of {array_name} differ in {low} to {high}")
        compared += ours.size
    return compared


def window(low, high, origin):
    return tuple(slice(low[d] - origin[d], high[d] - origin[d]) for d in (2, 1, 0))


def compare_field(level, key, many, image, box):
    name = f"{key[0]}_{key[1]}" if many else key[0]
    pieces, centring = level.fields[key], level.centring[key]
    none = np.zeros(3, dtype=int)
    if not centring.endswith("face"):
        return compare(image, box, name, centring == "node", none, pieces)
    up = none.copy()
    up["xyz".index(centring[0])] = 1
    return (compare(image, box, name + "_low", False, none, pieces)
            + compare(image, box, name + "_high", False, up, pieces))


def copies_of(level, images, number):
    image = next(image for l, image in images if l == number)
    return int(np.prod(image_box(level, image)[2]))


def check_blanking(levels, images):
    """VTK must hide exactly the coarse cells under finer boxes."""
    for number, level in enumerate(levels[:-1]):
        marks = [image.GetCellData().GetArray("vtkGhostType") for l, image in images if l == number]
        hidden = sum(int(np.count_nonzero(vtk_to_numpy(m))) for m in marks if m)
        fine = levels[number + 1]
        expected = sum(int(np.prod((upper - lower) // fine.ratio)) for lower, upper in fine.boxes)
        expected *= copies_of(level, images, number)
        if hidden != expected:
            raise AssertionError(f"level {number}: VTK hides {hidden} cells, {expected} are "
                                 "refined")


def compare_step(levels, path):
    images = images_of(path)
    materials = {}
    for level in levels:
        for name, material in level.fields:
            materials.setdefault(name, set()).add(material)
    compared = cells = 0
    for number, image in images:
        level = levels[number]
        box = image_box(level, image)
        cells += image.GetNumberOfCells() // int(np.prod(box[2]))
        for key in level.fields:
            compared += compare_field(level, key, len(materials[key[0]]) > 1, image, box)
    expected = sum(int(np.prod(upper - lower)) for level in levels for lower, upper in level.boxes)
    if cells != expected:
        raise AssertionError(f"{path}: {cells} cells, the archive has {expected}")
    if len(levels) > 1:
        check_blanking(levels, images)
    return compared


def check_paraview(pvd, times):
    from paraview.simple import OpenDataFile
    reader = OpenDataFile(str(pvd))
    if not np.array_equal(np.array(reader.TimestepValues, ndmin=1), times):
        raise AssertionError(f"ParaView sees times {reader.TimestepValues}, written were {times}")
    reader.UpdatePipeline(times[-1])
    if reader.GetDataInformation().GetNumberOfCells() == 0:
        raise AssertionError("ParaView sees no cells")


def main(archive, pvd, *options):
    archive, pvd = pathlib.Path(archive), pathlib.Path(pvd)
    steps = xml.parse(archive / "index.xml").getroot().find("timesteps").findall("timestep")
    exported = xml.parse(pvd).getroot().find("Collection").findall("DataSet")
    times = [float(step.get("time")) for step in steps]
    if times != [float(data_set.get("timestep")) for data_set in exported]:
        raise AssertionError("the times of archive and export differ")
    compared = 0
    for step, data_set in zip(steps, exported):
        compared += compare_step(read_step(archive / step.get("href")),
                                 pvd.parent / data_set.get("file"))
    if "--paraview" in options:
        check_paraview(pvd, times)
    if compared == 0:
        raise AssertionError("nothing was compared")
    print(f"verify_export: {compared} values in {len(times)} steps are equal")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except AssertionError as difference:
        print(f"verify_export: WRONG: {difference}")
        sys.exit(1)
