"""The levels of an archive in a picture: outer edges, boxes or tiles as thin lines, bands in 1-D.

What is drawn is one of KINDS, by default the first:
    edges   only where a level begins and ends
    boxes   the boxes of storage of each finer level (tiles are merged into them)
    tiles   the tiles of which a regridder composes a level, as the deck gives their size
    none    no lines
"""
import xml.etree.ElementTree as ElementTree

import numpy as np

from . import style
from .views import layer, plane_axes

KINDS = ("edges", "boxes", "tiles", "none")
DEFAULT_TILE = 8  # cells, where the deck's regridder has none


def colour(level):
    return style.COLOURS[level % len(style.COLOURS)]


def tile_of(archive, level):
    """Cells of a tile of this level, by the deck's <min_patch_size>; None without a regridder."""
    try:
        deck = ElementTree.parse(archive.path / "input.xml").getroot()
    except (OSError, ElementTree.ParseError):
        return None
    regridder = deck.find("AMR/Regridder")
    if regridder is None or level == 0:
        return None
    numbers = (regridder.findtext("min_patch_size") or "").replace("[", " ").replace("]", " ")
    values = [int(word) for word in numbers.replace(",", " ").split()]
    tiles = [tuple(values[n:n + 3]) for n in range(0, len(values) - 2, 3)]
    return tiles[min(level, len(tiles)) - 1] if tiles else (DEFAULT_TILE,) * 3


def _in_plane(level, normal, position):
    """The boxes of a level that the plane cuts."""
    at = layer(level, normal, position)
    return [(low, high) for low, high in level.boxes if low[normal] <= at < high[normal]]


def _cuts(low, high, origin, tile):
    """Edges of a box and those of the tiles in it."""
    first = origin + -(-(low - origin) // tile) * tile
    return sorted({low, high, *range(first, high, tile)})


def _box_lines(boxes, axes, origin=(0, 0, 0), tile=None):
    """Line segments [n, 2, 2] in cells: edges of boxes, with those of the tiles in them."""
    a, b = axes
    lines = []
    for low, high in boxes:
        across = _cuts(low[a], high[a], origin[a], tile[a]) if tile else (low[a], high[a])
        along = _cuts(low[b], high[b], origin[b], tile[b]) if tile else (low[b], high[b])
        lines += [((x, low[b]), (x, high[b])) for x in across]
        lines += [((low[a], y), (high[a], y)) for y in along]
    return np.array(lines, dtype=float).reshape(-1, 2, 2)


def _runs(edge):
    """Where True begins and ends along the second axis: (row, begin, end) arrays."""
    padded = np.pad(edge.astype(np.int8), ((0, 0), (1, 1)))
    change = np.diff(padded, axis=1)
    rows, begins = np.nonzero(change == 1)
    return rows, begins, np.nonzero(change == -1)[1]


def _outer_lines(boxes, axes):
    """Line segments in cells where cells of a level and others meet."""
    a, b = axes
    low = [min(box[0][d] for box in boxes) for d in axes]
    high = [max(box[1][d] for box in boxes) for d in axes]
    mask = np.zeros((high[0] - low[0] + 2, high[1] - low[1] + 2), dtype=bool)
    for first, last in boxes:
        mask[first[a] - low[0] + 1:last[a] - low[0] + 1,
             first[b] - low[1] + 1:last[b] - low[1] + 1] = True
    lines = []
    at, begins, ends = _runs(mask[1:] != mask[:-1])
    lines += [((low[0] + i, low[1] + m - 1), (low[0] + i, low[1] + n - 1))
              for i, m, n in zip(at, begins, ends)]
    at, begins, ends = _runs((mask[:, 1:] != mask[:, :-1]).T)
    lines += [((low[0] + m - 1, low[1] + j), (low[0] + n - 1, low[1] + j))
              for j, m, n in zip(at, begins, ends)]
    return np.array(lines, dtype=float).reshape(-1, 2, 2)


def plane_lines(step, kind, normal=None, position=None):
    """Of each finer level in a plane: (level, line segments [n, 2, 2])."""
    first, second, normal = plane_axes(step, normal)
    axes = (first, second)
    for level in step.levels[1:] if kind != "none" else ():
        boxes = _in_plane(level, normal, position)
        if not boxes:
            continue
        if kind == "edges":
            lines = _outer_lines(boxes, axes)
        else:
            tile = tile_of(step.archive, level.index) if kind == "tiles" else None
            lines = _box_lines(boxes, axes, level.lower, tile)
        origin = [level.anchor[d] for d in axes]
        yield level, origin + lines * [level.spacing[d] for d in axes]


def draw_plane_lines(ax, step, kind, normal=None, position=None):
    """Thin lines in the colour of each level, cased in white so that they show on any cell."""
    from matplotlib.collections import LineCollection
    from matplotlib.patheffects import withStroke
    if kind == "tiles":  # hair lines between those of the edges
        for level, lines in plane_lines(step, kind, normal, position):
            ax.add_collection(LineCollection(lines, colors=colour(level.index), linewidths=0.35,
                                             zorder=2 + level.index), autolim=False)
        kind = "edges"
    for level, lines in plane_lines(step, kind, normal, position):
        # Many small boxes need finer lines to leave something to see between them.
        width = 0.9 if len(lines) < 400 else 0.6
        ax.add_collection(LineCollection(
            lines, colors=colour(level.index), linewidths=width, zorder=2 + level.index,
            path_effects=[withStroke(linewidth=width + 0.8, foreground="white", alpha=0.7)]),
            autolim=False)


def share_text(step, level):
    """'level 1: 12 boxes, 3,456 cells, 21 % of the domain'."""
    def count(boxes):
        return sum(int(np.prod(np.subtract(high, low))) for low, high in boxes)
    cells = count(level.boxes)
    share = cells / count([(level.lower, level.upper)])
    text = f"{len(level.boxes)} box" + ("es" if len(level.boxes) != 1 else "")
    part = f", {100 * share:.2g} % of the domain" if share < 1 else ""
    return f"level {level.index}: {text}, {cells:,} cells{part}"


def handles(step):
    """For a legend: the colour of each level and how much of it there is."""
    from matplotlib.lines import Line2D
    return [Line2D([], [], linewidth=1.5, color=colour(level.index) if level.index else "none",
                   label=share_text(step, level)) for level in step.levels]


def bands(step, level):
    """1-D: where a level lies, as intervals of the drawn direction."""
    d = step.levels[0].active_directions()[0]
    joined = []
    for low, high in sorted((box[0][d], box[1][d]) for box in level.boxes):
        if joined and low <= joined[-1][1]:
            joined[-1][1] = max(high, joined[-1][1])
        else:
            joined.append([low, high])
    return [(level.anchor[d] + low * level.spacing[d], level.anchor[d] + high * level.spacing[d])
            for low, high in joined]


def draw_bands(ax, step, kind):
    """A tint behind each finer level, deeper where levels lie above each other."""
    for level in step.levels[1:] if kind != "none" else ():
        for low, high in bands(step, level):
            ax.axvspan(low, high, color=colour(level.index), alpha=0.12, linewidth=0, zorder=0)
