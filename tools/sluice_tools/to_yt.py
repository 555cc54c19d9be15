"""An output as a data set of yt (https://yt-project.org, version 4.1 or later).

Fields of cells of all levels become fields of yt: of one material ("sluice", "press_CC"); of
several ("sluice", "rho_CC.air"), named by material; of vectors ("sluice", "vel_CC.air.x").
Particles are not part of the data set: Output.particles() has them as arrays.
"""
import re

import numpy as np

from .archive import ArchiveError

NEEDED = ("to_yt() needs yt 4.1 or later, which this Python ({}) does not have: "
          "pip install 'yt>=4.1' (Debian has no package of it)")


def _unit(text):
    """'kg/m^3' as yt writes it; '' for numbers without a unit."""
    return "" if text in ("", "1") else re.sub(r"\s+", "*", text.replace("^", "**"))


def _columns(output, labels):
    """[(name in yt, label, material, component, unit)]."""
    step, variables = output.step, output.run.archive.variables
    cells = [name for name in step.names() if variables[name].centring == "cell"]
    unknown = [name for name in labels or () if name not in cells]
    if unknown:
        raise ArchiveError(f"no label of cells '{unknown[0]}'; there are: {', '.join(cells)}")
    found = []
    for label in labels or cells:
        there = step.materials(label)
        for material in there:
            name = label if len(there) == 1 else f"{label}.{output.run.materials[material]}"
            count = variables[label].components
            parts = [""] if count == 1 else [f".{'xyz'[c]}" for c in range(count)][:3]
            found += [(name + part, label, material, c, _unit(variables[label].unit))
                      for c, part in enumerate(parts)]
    return found


def refinement(levels):
    """Cells of a level along one of the next coarser, by direction; the same on all levels."""
    ratios = {tuple(level.ratio) for level in levels[1:]}
    if len(ratios) > 1:
        raise ArchiveError(f"yt knows one ratio of all levels; this run has {sorted(ratios)}")
    return list(ratios.pop()) if ratios else [2, 2, 2]


def grids_of(output, labels=None):
    """What yt.load_amr_grids takes: one dictionary a box."""
    columns = _columns(output, labels)
    grids = {}
    for name, label, material, component, unit in columns:
        for level in output.levels:
            for low, high, values in output.step.pieces(label, material, level.index):
                left, right = level.edges((low, high))
                grid = grids.setdefault((level.index, low, high), {
                    "left_edge": left, "right_edge": right, "level": level.index,
                    "dimensions": [high[d] - low[d] for d in range(3)]})
                grid["sluice", name] = (np.ascontiguousarray(values[component], dtype=float), unit)
    names = {("sluice", name) for name, *_ in columns}
    whole = [grid for grid in grids.values() if names <= grid.keys()]
    if len(whole) < len(grids):
        raise ArchiveError("the labels lie in different boxes: name fewer of them")
    return whole


def to_yt(output, labels=None):
    try:
        import yt
    except ImportError as error:
        import sys
        raise ArchiveError(NEEDED.format(sys.executable)) from error
    base = output.levels[0]
    low, high = base.edges((base.lower, base.upper))
    return yt.load_amr_grids(
        grids_of(output, labels), [base.upper[d] - base.lower[d] for d in range(3)],
        bbox=np.array([low, high]).T, refine_by=refinement(output.levels), length_unit="m",
        mass_unit="kg", time_unit="s", velocity_unit="m/s", sim_time=output.time,
        dataset_name=output.run.path.name)
