"""From fields to what is drawn: points along a line, cells in a plane, finest level first."""
import numpy as np

from .archive import ArchiveError


def split_name(name):
    """'vel_CC.x' -> ('vel_CC', 0); 'vel_CC' -> ('vel_CC', None)."""
    base, dot, component = name.partition(".")
    if not dot:
        return base, None
    if component not in ("x", "y", "z"):
        raise ArchiveError(f"'{name}': a component is x, y or z, as in {base}.x")
    return base, "xyz".index(component)


def scalar(field, component, along=None):
    """One number a cell: the named component, else in 1-D the one along the line, else the size."""
    if field.values.ndim == 3:
        if component is not None:
            raise ArchiveError(f"'{field.variable.name}' is not a vector: it has no components")
        return field.values
    if component is None and along is not None:
        component = along
    if component is not None:
        return field.values[component]
    return np.sqrt((field.values ** 2).sum(axis=0))


def covered(step, level, shape, lower):
    """True where the next finer level covers the cells of `level`."""
    mask = np.zeros(shape, dtype=bool)
    if level + 1 >= len(step.levels):
        return mask
    fine, coarse = step.levels[level + 1], step.levels[level]
    ratio = [round(coarse.spacing[d] / fine.spacing[d]) for d in range(3)]
    for low, high in fine.boxes:
        window = []
        for d in range(3):
            first = low[d] // ratio[d] - lower[d]
            last = -(-high[d] // ratio[d]) - lower[d]
            window.append(slice(max(first, 0), max(last, 0)))
        mask[tuple(window)] = True
    return mask


def line(step, name, material=None):
    """1-D: positions and values, each place once, from the finest level there, and the levels."""
    base, component = split_name(name)
    direction = step.levels[0].active_directions()[0]
    xs, values, levels = [], [], []
    for level in range(len(step.levels)):
        field = step.field(base, material, level)
        data = scalar(field, component, along=direction)
        keep = ~covered(step, level, data.shape, field.lower) & ~np.isnan(data)
        index = [0, 0, 0]
        index[direction] = slice(None)
        keep, data = keep[tuple(index)], data[tuple(index)]
        xs.append(field.coordinates(direction)[keep])
        values.append(data[keep])
        levels.append(np.full(keep.sum(), level))
    x, value, level = (np.concatenate(parts) for parts in (xs, values, levels))
    order = np.argsort(x, kind="stable")
    return x[order], value[order], level[order]


def plane_axes(step, normal=None):
    """The two drawn directions and the normal of the plane (None in 2-D)."""
    active = step.levels[0].active_directions()
    if len(active) == 2 and normal is None:
        return active[0], active[1], ({0, 1, 2} - set(active)).pop()
    normal = 2 if normal is None else normal
    first, second = sorted({0, 1, 2} - {normal})
    return first, second, normal


def plane(step, name, material=None, normal=None, position=None):
    """2-D or a slice of 3-D: per level (edges of the first axis, of the second, values[j, i])."""
    base, component = split_name(name)
    first, second, normal = plane_axes(step, normal)
    sheets = []
    for level, grid in enumerate(step.levels):
        field = step.field(base, material, level)
        data = scalar(field, component)
        if position is None:
            at = 0.5 * (grid.lower[normal] + grid.upper[normal])
        else:
            at = (position - grid.anchor[normal]) / grid.spacing[normal]
        index = int(np.floor(at)) - field.lower[normal]
        if level == 0 and not 0 <= index < data.shape[normal]:
            raise ArchiveError(f"the plane {'xyz'[normal]} = {position:g} lies outside the domain")
        if not 0 <= index < data.shape[normal]:
            continue
        sheet = np.take(data, index, axis=normal)
        sheets.append((_edges(field, first), _edges(field, second), sheet.T))
    return sheets


def _edges(field, direction):
    centres = field.coordinates(direction)
    half = 0.5 * field.level.spacing[direction]
    return np.append(centres - half, centres[-1] + half)


def outlines(step, normal=None, position=None):
    """Rectangles (x, y, width, height) of the boxes of the finer levels in the plane."""
    first, second, normal = plane_axes(step, normal)
    for level in step.levels[1:]:
        for box in level.boxes:
            low, high = level.edges(box)
            if position is not None and not low[normal] <= position < high[normal]:
                continue
            yield low[first], low[second], high[first] - low[first], high[second] - low[second]
