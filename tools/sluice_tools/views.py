"""From fields to what is drawn: points along a line, cells in a plane, finest level first."""
import numpy as np

from .archive import ArchiveError
from .scalars import scalar, split_name


def stored_levels(step, base, material=None):
    """The levels that hold this variable (of this material, or of the first that has it)."""
    if not step.has(base):
        step.field(base, material)  # tells what there is
    if material is None:
        material = step.materials(base)[0]
    found = [level for name, matl, level in step.stored() if name == base and matl == material]
    if not found:
        step.field(base, material)
    return found


def covered(step, level, shape, lower, by=None):
    """True where the next finer level, or the level `by`, covers the cells of `level`."""
    mask = np.zeros(shape, dtype=bool)
    by = level + 1 if by is None else by
    if by >= len(step.levels):
        return mask
    fine, coarse = step.levels[by], step.levels[level]
    ratio = [round(coarse.spacing[d] / fine.spacing[d]) for d in range(3)]
    for low, high in fine.boxes:
        window = []
        for d in range(3):
            first = low[d] // ratio[d] - lower[d]
            last = -(-high[d] // ratio[d]) - lower[d]
            window.append(slice(max(first, 0), max(last, 0)))
        mask[tuple(window)] = True
    return mask


def _with_finer(levels):
    """(level, the next finer one that is there or one that is not)."""
    return zip(levels, [*levels[1:], 1 << 30])


def profiles(step, name, material=None):
    """1-D, level by level: (level, positions, values or NaN, is a finer level there)."""
    base, component = split_name(name)
    direction = step.levels[0].active_directions()[0]
    for level, finer in _with_finer(stored_levels(step, base, material)):
        field = step.field(base, material, level)
        data = scalar(base, field.values, component, along=direction)
        hidden = covered(step, level, data.shape, field.lower, finer)
        index = [0, 0, 0]
        index[direction] = slice(None)
        yield level, field.coordinates(direction), data[tuple(index)], hidden[tuple(index)]


def radii(step, name, material=None):
    """2-D and 3-D, level by level: (level, distances from the origin, values) of the cells that no
    finer level covers; of a vector the component away from the origin."""
    base, component = split_name(name)
    directions = step.levels[0].active_directions()
    for level, finer in _with_finer(stored_levels(step, base, material)):
        field = step.field(base, material, level)
        axes = np.meshgrid(*[field.coordinates(d) if d in directions else [0.0]
                             for d in range(3)], indexing="ij")
        radius = np.sqrt(sum(axis ** 2 for axis in axes))
        if field.variable.components == 3 and component is None:
            away = sum(field.values[d] * axes[d] for d in directions)
            data = np.divide(away, radius, out=np.zeros_like(away), where=radius > 0)
        else:
            data = scalar(base, field.values, component)
        seen = ~covered(step, level, data.shape, field.lower, finer) & np.isfinite(data)
        yield level, radius[seen], data[seen]


def line(step, name, material=None):
    """1-D: positions and values, each place once, from the finest level there, and the levels."""
    parts = []
    for level, x, values, hidden in profiles(step, name, material):
        keep = ~hidden & ~np.isnan(values)
        parts.append((x[keep], values[keep], np.full(keep.sum(), level)))
    x, value, level = (np.concatenate(part) for part in zip(*parts))
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


def check_slice(step, normal, position):
    """A slice is a plane of a three-dimensional run; another one says which plane there is."""
    if normal is None:
        return
    active = step.levels[0].active_directions()
    axes = " and ".join("xyz"[d] for d in active)
    if len(active) == 1:
        raise ArchiveError(f"--slice is for planes; this run is a line along {axes}: without "
                           "--slice its profiles are drawn")
    level = step.levels[0]
    low, high = (level.anchor[normal] + edge[normal] * level.spacing[normal]
                 for edge in (level.lower, level.upper))
    if len(active) == 2:
        flat = ({0, 1, 2} - set(active)).pop()
        middle = level.anchor[flat] + (0.5 * (level.lower[flat] + level.upper[flat]) *
                                       level.spacing[flat])
        raise ArchiveError(f"--slice is for three-dimensional runs; this one has {axes}: its only "
                           f"plane is {'xyz'[flat]} = {middle:g}, drawn without --slice")
    if not low <= position <= high:
        nearest = low + 0.5 * level.spacing[normal] if position < low \
            else high - 0.5 * level.spacing[normal]
        raise ArchiveError(f"the plane {'xyz'[normal]} = {position:g} lies outside the domain, "
                           f"{low:g} to {high:g}: the nearest layer of cells is at {nearest:g}")


def plane(step, name, material=None, normal=None, position=None):
    """2-D or a slice of 3-D, level by level: (edges of the first axis, of the second, values[j, i],
    is a finer level there[j, i])."""
    base, component = split_name(name)
    first, second, normal = plane_axes(step, normal)
    sheets = []
    for level, finer in _with_finer(stored_levels(step, base, material)):
        field = step.field(base, material, level)
        data = scalar(base, field.values, component)
        index = layer(step.levels[level], normal, position) - field.lower[normal]
        if not 0 <= index < data.shape[normal]:
            if level == 0:
                raise ArchiveError(f"the plane {'xyz'[normal]} = {position:g} lies outside the "
                                   "domain")
            continue
        hidden = covered(step, level, data.shape, field.lower, finer)
        sheets.append((_edges(field, first), _edges(field, second),
                       np.take(data, index, axis=normal).T,
                       np.take(hidden, index, axis=normal).T))
    return sheets


def layer(level, normal, position=None):
    """The layer of cells of a level in which a plane lies (without a position: the middle one)."""
    if position is None:
        return (level.lower[normal] + level.upper[normal]) // 2
    cell = int(np.floor((position - level.anchor[normal]) / level.spacing[normal]))
    high = level.anchor[normal] + level.upper[normal] * level.spacing[normal]
    return level.upper[normal] - 1 if position == high else cell  # the domain is closed


def near_plane(step, places, normal=None, position=None):
    """Which places lie in a plane's layer of cells of the coarsest level; in 2-D: all."""
    if len(step.levels[0].active_directions()) < 3:
        return np.ones(len(places), dtype=bool)
    level, normal = step.levels[0], 2 if normal is None else normal
    cells = np.floor((places[:, normal] - level.anchor[normal]) / level.spacing[normal])
    return cells == layer(level, normal, position)


def _edges(field, direction):
    centres = field.coordinates(direction)
    half = 0.5 * field.level.spacing[direction]
    return np.append(centres - half, centres[-1] + half)
