#!/usr/bin/python3
"""Reads an export of an archive back with VTK and compares every number with the archive itself.

usage: verify_export.py ARCHIVE EXPORT.pvd|EXPORT.vthb.series [--paraview]

The archive is read by sluice_tools from its documented layout, the export with VTK's own readers
(and, with --paraview, its times with ParaView's). Exit status: 0 all numbers are equal to the bit,
1 one is not, 77 vtkmodules or h5py is not installed.
"""

import json
import pathlib
import sys
import xml.etree.ElementTree as xml

SKIPPED = 77

try:
    import h5py  # noqa: F401  the archive's reader asks for it when it reads
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import (vtkXMLImageDataReader, vtkXMLMultiBlockDataReader,
                                     vtkXMLPolyDataReader, vtkXMLUniformGridAMRReader)
except ImportError as missing:
    print(f"verify_export: skipped: {missing}")
    sys.exit(SKIPPED)

from sluice_tools import materials  # needs NumPy
from sluice_tools.archive import Archive, ArchiveError


def images_of(path):
    """[(level, image)] of a .vti, .vtm or .vthb file."""
    if path.suffix == ".vti":
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        return [(0, reader.GetOutput())]
    if path.suffix == ".vtm":
        reader = vtkXMLMultiBlockDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        levels = reader.GetOutput()
        return [(level, levels.GetBlock(level).GetBlock(n))
                for level in range(levels.GetNumberOfBlocks())
                for n in range(levels.GetBlock(level).GetNumberOfBlocks())]
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
    spacing, wanted = np.array(image.GetSpacing()), np.array(level.spacing)
    copies = np.round(wanted / spacing).astype(int)
    if np.any(copies < 1) or not np.allclose(spacing * copies, wanted, rtol=1e-12):
        raise AssertionError(f"spacing {spacing} is not {wanted}")
    extent = np.array(image.GetExtent()).reshape(3, 2)
    corners = (np.array(image.GetOrigin()) - level.anchor) / wanted
    corners = corners + extent.T / copies
    if not np.allclose(corners, np.round(corners), atol=1e-9):
        raise AssertionError(f"origin {image.GetOrigin()} is not on the level's corners")
    lower, upper = np.round(corners).astype(int)
    return lower, upper, copies


def one_of_each(found, copies):
    """The array [component, i, j, k] without the copies; all copies must be equal."""
    for axis, count in enumerate(copies, 1):
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
    found = one_of_each(vtk_to_numpy(array).reshape(shape).transpose(3, 2, 1, 0), copies)
    compared = 0
    for piece_lower, piece_upper, values in pieces:
        low = np.maximum(lower, piece_lower - shift)
        high = np.minimum(upper, piece_upper - shift)
        if np.any(high <= low):
            continue
        ours = values[window(low, high, piece_lower - shift)]
        theirs = found[window(low, high, lower)]
        if not np.array_equal(ours.astype(theirs.dtype), theirs, equal_nan=True):
            raise AssertionError(f"values of {array_name} differ in {low} to {high}")
        compared += ours.size
    return compared


def window(low, high, origin):
    return (slice(None), *(slice(low[d] - origin[d], high[d] - origin[d]) for d in range(3)))


def compare_field(name, centring, pieces, image, box):
    none = np.zeros(3, dtype=int)
    if not centring.endswith("face"):
        return compare(image, box, name, centring == "node", none, pieces)
    up = none.copy()
    up["xyz".index(centring[0])] = 1
    return (compare(image, box, name + "_low", False, none, pieces)
            + compare(image, box, name + "_high", False, up, pieces))


def box_cells(boxes, ratio=(1, 1, 1)):
    return sum(int(np.prod((np.array(upper) - lower) // ratio)) for lower, upper in boxes)


def check_blanking(levels, images):
    """VTK must hide exactly the coarse cells under finer boxes."""
    for number, level in enumerate(levels[:-1]):
        mine = [image for at, image in images if at == number]
        marks = [image.GetCellData().GetArray("vtkGhostType") for image in mine]
        hidden = sum(int(np.count_nonzero(vtk_to_numpy(m))) for m in marks if m)
        fine = levels[number + 1]
        expected = box_cells(fine.boxes, fine.ratio) * int(np.prod(image_box(level, mine[0])[2]))
        if hidden != expected:
            raise AssertionError(f"level {number}: VTK hides {hidden} cells, {expected} are "
                                 "refined")


def name_of(archive, label, material):
    if archive.variables[label].materials == 1:
        return label
    return f"{label}_{materials.names(archive)[material].removeprefix('material ')}"


def compare_step(step, path):
    images = images_of(path)
    kinds = step.archive.variables
    fields = {key: step.pieces(*key) for key in step.stored()
              if kinds[key[0]].centring != "particle"}
    compared = cells = 0
    for number, image in images:
        box = image_box(step.levels[number], image)
        cells += image.GetNumberOfCells() // int(np.prod(box[2]))
        for (name, material, level), pieces in fields.items():
            if level == number:
                exported = name_of(step.archive, name, material)
                centring = step.archive.variables[name].centring
                compared += compare_field(exported, centring, pieces, image, box)
    expected = sum(box_cells(level.boxes) for level in step.levels)
    if cells != expected:
        raise AssertionError(f"{path}: {cells} cells, the archive has {expected}")
    if len(step.levels) > 1:
        check_blanking(step.levels, images)
    return compared


def compare_points(step, material, path):
    """Particles of a material against a .vtp file; each must be a vertex that is drawn."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    points = reader.GetOutput()
    particles = step.particles(material)
    if points.GetNumberOfVerts() != len(particles["p.particleID"]):
        raise AssertionError(f"{path.name}: {points.GetNumberOfVerts()} vertices")
    compared = 0
    for name, values in particles.items():
        array = (points.GetPoints().GetData() if name == "p.x"
                 else points.GetPointData().GetArray(name))
        if array is None or not np.array_equal(vtk_to_numpy(array), values):
            raise AssertionError(f"{path.name}: values of {name} differ")
        compared += values.size
    return compared


def compare_particles(archive, pvd):
    """All that the collection of particles names; nothing where the archive has none."""
    steps = [archive.step(f"#{n}") for n in range(len(archive.steps))]
    wanted = [(step, m) for step in steps for m in step.particle_materials()]
    if not wanted:
        return 0
    name = step_name(pvd).removesuffix("_particles")
    collection = pvd.with_name(name + "_particles.pvd")
    exported = xml.parse(collection).getroot().find("Collection").findall("DataSet")
    if len(exported) != len(wanted):
        raise AssertionError(f"{collection.name} names {len(exported)} files, not {len(wanted)}")
    compared = 0
    for (step, material), data_set in zip(wanted, exported):
        if float(data_set.get("timestep")) != step.time:
            raise AssertionError(f"{collection.name}: another time than {step.time}")
        compared += compare_points(step, material, pvd.parent / data_set.get("file"))
    return compared


def check_first_look(path):
    """What an AMR reader shows before it is asked for finer levels has no holes."""
    reader = vtkXMLUniformGridAMRReader()
    reader.SetFileName(str(path))
    reader.Update()
    coarse = reader.GetOutput()
    for n in range(coarse.GetNumberOfDataSets(0)):
        marks = coarse.GetDataSet(0, n).GetCellData().GetArray("vtkGhostType")
        if marks and np.any(vtk_to_numpy(marks)):
            raise AssertionError(f"{path.name}: the coarsest level alone has holes")


def step_name(path):
    return path.name.removesuffix(".series").rsplit(".", 1)[0]


def files_of(path):
    """[(time, file)] of a .pvd or a .vthb.series."""
    if path.suffix == ".series":
        entries = json.loads(path.read_text())["files"]
        return [(entry["time"], path.parent / entry["name"]) for entry in entries]
    return [(float(data_set.get("timestep")), path.parent / data_set.get("file"))
            for data_set in xml.parse(path).getroot().find("Collection").findall("DataSet")]


def check_paraview(pvd, times, last):
    """Times, and that all levels are there at once: as many cells as the images of the last."""
    from paraview.simple import OpenDataFile
    reader = OpenDataFile(str(pvd))
    if not np.array_equal(np.array(reader.TimestepValues, ndmin=1), times):
        raise AssertionError(f"ParaView sees times {reader.TimestepValues}, written were {times}")
    reader.UpdatePipeline(times[-1])
    found = reader.GetDataInformation().GetNumberOfCells()
    expected = sum(image.GetNumberOfCells() for _, image in images_of(last))
    if found != expected:
        raise AssertionError(f"ParaView sees {found} cells, the export has {expected}")


def main(archive, path, *options):
    archive, path = Archive(archive), pathlib.Path(path)
    times = [time for _, time, _ in archive.steps]
    of_points = path.name.endswith("_particles.pvd")
    exported = [] if of_points else files_of(path)
    if not of_points and times != [time for time, _ in exported]:
        raise AssertionError("the times of archive and export differ")
    compared = 0
    for number, (_, file) in enumerate(exported):
        compared += compare_step(archive.step(f"#{number}"), file)
        if file.suffix == ".vthb":
            check_first_look(file)
    compared += compare_particles(archive, path)
    if "--paraview" in options and path.suffix == ".pvd" and not of_points:
        check_paraview(path, times, exported[-1][1])
    if compared == 0:
        raise AssertionError("nothing was compared")
    print(f"verify_export: {compared} values in {len(times)} steps are equal")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (AssertionError, ArchiveError) as difference:
        print(f"verify_export: WRONG: {difference}")
        sys.exit(1)
