"""The shapes of particles: parallelepipeds, and the parallelograms in which a plane meets them.

A particle is the image of a box under its deformation gradient F. The widths of the box are those
that the deck gave it: the spacing of a cell over the number of particles along it. Where F is not
saved, the box keeps its proportions and has the saved volume, or stays as it was.
"""
import numpy as np

from . import materials

OVERLAP = 1.04  # neighbours overlap by this factor, so that no seams show between them


def _spacings(step):
    return [np.array(level.spacing, dtype=float) for level in step.levels]


def _counts(archive, material):
    """Different numbers [nx, ny, nz] of particles in a cell, of a material's geometry objects."""
    found = materials.elements(archive)
    if material >= len(found):
        return []
    counts = []
    for e in found[material][1].iterfind("geom_object"):
        text = e.findtext("res", "").strip().strip("[]")
        try:
            count = [max(1, round(float(part))) for part in text.split(",")]
        except ValueError:
            continue
        if len(count) == 3 and count not in counts:
            counts.append(count)
    return counts


def first_widths(step, material, volumes):
    """Widths [n, 3] of particles at the start whose volumes were volumes[n] (None: not known): of
    all that levels and geometry objects allow those of the nearest volume."""
    counts = _counts(step.archive, material) or [[2, 2, 2]]
    active = step.levels[0].active_directions()
    widths = []
    for spacing in _spacings(step):
        for count in counts:
            divided = [count[d] if d in active else 1 for d in range(3)]
            widths.append(spacing / divided)
    widths = np.array(widths)
    if volumes is None:
        return widths[:1]
    sizes = widths.prod(axis=1)
    safe = np.where(volumes > 0, volumes, sizes[0])
    return widths[np.abs(np.log(safe[:, None] / sizes[None, :])).argmin(axis=1)]


def _determinants(table, name):
    return np.abs(np.linalg.det(table[name].reshape(-1, 3, 3)))


def edges(step, material, table):
    """Edges of particles as columns: [n, 3, 3], m. The table holds p.x and what is saved of
    NEEDED."""
    count = len(table["p.x"])
    if "p.scalefactor" in table:
        return table["p.scalefactor"].reshape(-1, 3, 3)
    volumes = np.abs(table["p.volume"]) if "p.volume" in table else None
    if "p.deformationMeasure" in table:
        deformed = table["p.deformationMeasure"].reshape(-1, 3, 3)
        if volumes is not None:
            volumes = volumes / np.maximum(_determinants(table, "p.deformationMeasure"), 1e-300)
        widths = np.broadcast_to(first_widths(step, material, volumes), (count, 3))
        return deformed * widths[:, None, :]
    widths = np.broadcast_to(first_widths(step, material, volumes), (count, 3)).copy()
    if volumes is not None:
        active = step.levels[0].active_directions()
        growth = (volumes / widths.prod(axis=1)) ** (1 / len(active))
        widths[:, active] *= growth[:, None]
    return widths[:, :, None] * np.eye(3)


NEEDED = {"p.volume", "p.deformationMeasure", "p.scalefactor"}


def sections(places, edges_of, normal, position):
    """Where a plane across `normal` at `position` meets particles: (which [n] it meets, corners
    [m, 4, 2] of the parallelograms).

    The edge that rises most out of the plane is a long prism; the plane cuts it obliquely in the
    other two edges, shifted along the first. Prisms of a uniform deformation fill the plane.
    """
    first, second = (d for d in range(3) if d != normal)
    rows = np.arange(len(places))
    steep = np.abs(edges_of[:, normal, :]).argmax(axis=1)
    up = edges_of[rows, :, steep]
    rise = np.where(up[:, normal] == 0, 1e-300, up[:, normal])
    depth = (position - places[:, normal]) / rise
    met = np.abs(depth) <= 0.5 * OVERLAP
    centres = (places + depth[:, None] * up)[met]
    flat = []
    for other in (1, 2):
        edge = edges_of[rows, :, (steep + other) % 3]
        flat.append((edge - (edge[:, normal] / rise)[:, None] * up)[met])
    signs = 0.5 * OVERLAP * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    corners = (centres[:, None] + signs[None, :, :1] * flat[0][:, None]
               + signs[None, :, 1:] * flat[1][:, None])
    return met, corners[:, :, [first, second]]
