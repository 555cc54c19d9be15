"""Values at points and along lines: of the cell (or node) that holds a point, on the finest level
there."""
import numpy as np

from .archive import TENSOR, ArchiveError
from .quantities import SCHLIEREN, label_of, level_field
from .views import stored_levels

MOST = 4000  # points of a line, more than a picture has pixels


def indices(field, points):
    """Indices [n, 3] into field.values of the cells or nodes nearest to points; -1 outside."""
    level = field.level
    found = np.empty((len(points), 3), dtype=int)
    for d in range(3):
        count = field.values.shape[d - 3]
        shift = field.coordinates(d)[0] - level.anchor[d] - field.lower[d] * level.spacing[d]
        place = (points[:, d] - level.anchor[d] - shift) / level.spacing[d] + 0.5
        index = np.floor(place).astype(int) - field.lower[d]
        high = level.anchor[d] + level.upper[d] * level.spacing[d]
        index = np.where((points[:, d] == high) & (index == count), count - 1, index)
        if level.upper[d] - level.lower[d] == 1:  # a flat direction holds every point
            index = np.zeros_like(index)
        found[:, d] = np.where((index >= 0) & (index < count), index, -1)
    return found


def _boxes_of(field):
    """True where a box of the level lies, in the shape of its values."""
    mask = np.zeros(field.values.shape[-3:], dtype=bool)
    for low, high in field.level.boxes:
        mask[tuple(slice(max(low[d] - field.lower[d], 0), max(high[d] - field.lower[d] + 1, 0))
                   if field.variable.centring != "cell" else
                   slice(max(low[d] - field.lower[d], 0), max(high[d] - field.lower[d], 0))
                   for d in range(3))] = True
    return mask


def sample_scalar(step, name, points, material=None, along=None):
    """(values [n], levels [n]) of one number a place; NaN where the material is not, level -1
    outside of what is stored."""
    points = np.atleast_2d(np.asarray(points, dtype=float))
    values = np.full(len(points), np.nan)
    levels = np.full(len(points), -1)
    for level in stored_levels(step, name, material):
        field = level_field(step, name, material, level, along)
        at = indices(field, points)
        inside = (at >= 0).all(axis=1)
        inside[inside] = _boxes_of(field)[tuple(at[inside].T)]
        values[inside] = field.values[tuple(at[inside].T)]
        levels[inside] = level
    return values, levels


def sample(step, name, points, material=None):
    """Values [n], of vectors [n, 3], of tensors [n, 9], at points [n, 3] (m)."""
    base = label_of(step, name)
    variable = step.archive.variables.get(base)
    parts = [name]
    if variable is not None and name == base and name != SCHLIEREN and variable.components > 1:
        parts = [f"{name}.{c}" for c in ("xyz" if variable.components == 3 else TENSOR)]
    columns = [sample_scalar(step, part, points, material)[0] for part in parts]
    return columns[0] if len(parts) == 1 else np.stack(columns, axis=1)


def line_points(step, first, last):
    """(distances [n] from the first point, points [n, 3]): the middles of the pieces into which the
    cells of the finest level cut a line."""
    first, last = np.asarray(first, dtype=float), np.asarray(last, dtype=float)
    length = np.linalg.norm(last - first)
    if length == 0:
        raise ArchiveError("--line: both points are the same")
    level = step.levels[-1]
    cuts = [np.array([0.0, 1.0])]
    for d in range(3):
        if last[d] == first[d]:
            continue
        ends = sorted(((first[d] - level.anchor[d]) / level.spacing[d],
                       (last[d] - level.anchor[d]) / level.spacing[d]))
        faces = np.arange(np.ceil(ends[0]), np.floor(ends[1]) + 1)
        share = (level.anchor[d] + faces * level.spacing[d] - first[d]) / (last[d] - first[d])
        cuts.append(share[(share > 0) & (share < 1)])
    cuts = np.unique(np.round(np.concatenate(cuts), 12))
    if len(cuts) > MOST:
        cuts = np.linspace(0, 1, MOST)
    shares = 0.5 * (cuts[1:] + cuts[:-1])
    return length * shares, first + shares[:, None] * (last - first)


def along_line(step, name, first, last, material=None):
    """(distances from the first point, values, levels) where the line lies in the domain."""
    distances, points = line_points(step, first, last)
    values, levels = sample_scalar(step, name, points, material)
    if (levels < 0).all():
        raise ArchiveError(f"--line: no point of it lies in the domain, which is "
                           f"{_domain_text(step)}")
    keep = levels >= 0
    return distances[keep], values[keep], levels[keep]


def _domain_text(step):
    level = step.levels[0]
    return " x ".join("[{:g}, {:g}]".format(*(level.anchor[d] + n[d] * level.spacing[d]
                                              for n in (level.lower, level.upper)))
                      for d in range(3))
