"""From fields to what is drawn: points along a line, cells in a plane, finest level first."""
import numpy as np

from .archive import ArchiveError
from .quantities import label_of, level_field, material_of


def stored_levels(step, name, material=None):
    """The levels that hold this variable (of this material, or of the first that has it)."""
    base = label_of(step, name)
    if not step.has(base):
        step.field(base, material)  # tells what there is
    own = material_of(step, base, material)
    own = step.materials(base)[0] if own is None else own
    found = [level for label, matl, level in step.stored() if label == base and matl == own]
    if not found:
        step.field(base, own)
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
    direction = step.levels[0].active_directions()[0]
    for level, finer in _with_finer(stored_levels(step, name, material)):
        field = level_field(step, name, material, level, along=direction)
        hidden = covered(step, level, field.values.shape, field.lower, finer)
        index = [0, 0, 0]
        index[direction] = slice(None)
        yield level, field.coordinates(direction), field.values[tuple(index)], hidden[tuple(index)]


def radii(step, name, material=None):
    """2-D and 3-D, level by level: (level, distances from the origin, values) of the cells that no
    finer level covers; of a vector the component away from the origin."""
    directions = step.levels[0].active_directions()
    for level, finer in _with_finer(stored_levels(step, name, material)):
        field = level_field(step, name, material, level)
        axes = np.meshgrid(*[field.coordinates(d) if d in directions else [0.0]
                             for d in range(3)], indexing="ij")
        radius = np.sqrt(sum(axis ** 2 for axis in axes))
        data = field.values
        if field.variable.components == 3 and "." not in name:
            parts = [level_field(step, f"{name}.{'xyz'[d]}", material, level).values * axes[d]
                     for d in directions]
            data = np.divide(sum(parts), radius, out=np.zeros_like(data), where=radius > 0)
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
    first, second, normal = plane_axes(step, normal)
    sheets = []
    for level, finer in _with_finer(stored_levels(step, name, material)):
        field = level_field(step, name, material, level)
        data = field.values
        index = layer(step.levels[level], normal, position) - field.lower[normal]
        if not 0 <= index < data.shape[normal]:
            if level == 0:
                raise ArchiveError(f"the plane {'xyz'[normal]} = {position:g} lies outside the "
                                   "domain")
            continue
        hidden = covered(step, level, data.shape, field.lower, finer)
        sheets.append((edges_of(field, first), edges_of(field, second),
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


def plane_position(step, normal, position=None):
    """Where a plane lies: the position, or the middle of the middle layer of cells."""
    level = step.levels[0]
    if position is not None:
        return position
    return level.anchor[normal] + (layer(level, normal) + 0.5) * level.spacing[normal]


def near_plane(step, places, normal=None, position=None):
    """Which places lie in a plane's layer of cells of the coarsest level; in 2-D: all."""
    if len(step.levels[0].active_directions()) < 3:
        return np.ones(len(places), dtype=bool)
    level, normal = step.levels[0], 2 if normal is None else normal
    cells = np.floor((places[:, normal] - level.anchor[normal]) / level.spacing[normal])
    return cells == layer(level, normal, position)


def edges_of(field, direction):
    centres = field.coordinates(direction)
    half = 0.5 * field.level.spacing[direction]
    return np.append(centres - half, centres[-1] + half)


def composed(sheets, limit=4_000_000):
    """The sheets of a plane as one: (centres of the first axis, of the second, values[j, i]) on the
    cells of the finest level, or of the finest one that needs at most `limit` values."""
    low = [min(sheet[a][0] for sheet in sheets) for a in (0, 1)]
    high = [max(sheet[a][-1] for sheet in sheets) for a in (0, 1)]
    for xs, ys, _, _ in reversed(sheets):
        count = [round((high[0] - low[0]) / (xs[1] - xs[0])),
                 round((high[1] - low[1]) / (ys[1] - ys[0]))]
        if count[0] * count[1] <= limit:
            break
    centres = [low[a] + (np.arange(count[a]) + 0.5) * (high[a] - low[a]) / count[a]
               for a in (0, 1)]
    whole = np.full((count[1], count[0]), np.nan)
    for xs, ys, values, hidden in sheets:
        i = np.searchsorted(xs, centres[0]) - 1
        j = np.searchsorted(ys, centres[1]) - 1
        columns = np.nonzero((i >= 0) & (i < values.shape[1]))[0]
        rows = np.nonzero((j >= 0) & (j < values.shape[0]))[0]
        at, into = np.ix_(j[rows], i[columns]), np.ix_(rows, columns)
        whole[into] = np.where(np.isfinite(values[at]) & ~hidden[at], values[at], whole[into])
    return centres[0], centres[1], whole


def domain(step, directions):
    """[(low, high)] of the domain along these directions, m."""
    level = step.levels[0]
    return [tuple(level.anchor[d] + n[d] * level.spacing[d] for n in (level.lower, level.upper))
            for d in directions]
