#!/usr/bin/env python3
"""Open an export of one level in ParaView: its numbers must be the archive's; draw a picture.

Run under a screen (xvfb-run), by the Python that has the package paraview.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def draw(reader, name, picture):
    view = simple.CreateRenderView()
    view.ViewSize = [900, 700]
    view.OrientationAxesVisibility = 0
    shown = simple.Show(reader, view)
    shown.SetRepresentationType("Surface")
    simple.ColorBy(shown, ("CELLS", name))
    shown.RescaleTransferFunctionToDataRange(True)
    shown.SetScalarBarVisibility(view, True)
    simple.ResetCamera(view)
    simple.SaveScreenshot(str(picture), view)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--export", required=True, type=pathlib.Path)
    parser.add_argument("--csv", required=True, type=pathlib.Path)
    parser.add_argument("--picture", required=True, type=pathlib.Path)
    parser.add_argument("--var", default="press_CC")
    given = parser.parse_args()

    reader = simple.PVDReader(FileName=str(next(given.export.glob("*.pvd"))))
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    reader.UpdatePipeline(time=times[-1])
    cells = servermanager.Fetch(reader).GetCellData()
    mine = vtk_to_numpy(cells.GetArray(given.var))
    with open(given.csv, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    expected = np.array([float(row["value"]) for row in rows])

    if float(rows[0]["time"]) != times[-1]:
        print(f"RESULT: ParaView's last time is {times[-1]}, the archive's {rows[0]['time']}")
        return 1
    if mine.shape != expected.shape or not np.array_equal(mine, expected):
        print(f"RESULT: {given.var} differs in ParaView: {len(mine)} values, {len(expected)} in "
              "the archive")
        return 1
    simple.GetAnimationScene().AnimationTime = times[-1]
    draw(reader, given.var, given.picture)
    picture = simple.PNGSeriesReader(FileNames=[str(given.picture)])
    low, high = picture.PointData[0].GetRange(0)
    if high - low < 20:
        print("RESULT: the picture is empty")
        return 1
    print(f"RESULT: {len(times)} outputs, {len(mine)} values of {given.var} equal in ParaView "
          f"{simple.GetParaViewVersion()}; picture drawn")
    return 0


if __name__ == "__main__":
    sys.exit(main())
