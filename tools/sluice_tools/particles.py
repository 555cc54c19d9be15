"""Pictures of particles: coloured by what they carry, outlines of bodies, paths."""
import numpy as np

from . import scalars, style, views
from .archive import ArchiveError

USUAL = ["p.stress", "p.velocity", "p.temperature", "p.color"]
WIDER = 1.1  # so that no lines show between particles of a stretched body
CLOSE = 0.3  # bodies that take less of the domain along both axes are drawn from near


def is_of_particles(archive, name):
    variable = archive.variables.get(scalars.split_name(name)[0])
    return variable is not None and variable.centring == "particle"


def usual_variables(step):
    """What is drawn of an archive of solids; nothing where it has no particles."""
    found = [name for name in USUAL if step.has(name)]
    return found or (["p.x"] if step.has("p.x") else [])


def materials_of(step, given, base="p.x"):
    there = step.materials(base)
    if given.material is None:
        return there
    if given.material not in there:
        raise ArchiveError(f"no particles of material {given.material} with {base}; materials: "
                           f"{there}")
    return [given.material]


class Cut:
    """The particles of a material that a picture shows: all of a plane, a layer of cells of a run
    in three dimensions. places[n, 2], their widths[n], numbers[n] of the variable `name`."""

    def __init__(self, step, name, material, given):
        base, component = scalars.split_name(name)
        wanted = {"p.x", "p.volume", "p.particleID", base}
        table = step.particles(material, wanted)
        if base not in table:
            raise ArchiveError(f"particles of material {material} have no '{base}'; there are: "
                               f"{', '.join(n for n in step.names() if n.startswith('p.'))}")
        first, second, normal = views.plane_axes(step, given.normal)
        near = views.near_plane(step, table["p.x"], given.normal, given.position)
        self.places = table["p.x"][near][:, [first, second]]
        self.widths = _widths(step, table, normal)[near]
        kept = table[base][near]
        columns = kept.T if kept.ndim == 2 else kept
        self.numbers = scalars.scalar(base, columns, component)


def _widths(step, table, normal):
    """Of squares (in a plane) or cubes of the particles' volumes; without volumes half a cell."""
    spacing = step.levels[-1].spacing
    active = step.levels[0].active_directions()
    if "p.volume" not in table:
        return np.full(len(table["p.x"]), 0.5 * min(spacing[d] for d in active))
    volume = np.abs(table["p.volume"])
    if len(active) < 3:
        return np.sqrt(volume / step.levels[0].spacing[normal])
    return np.cbrt(volume)


def draw_panel(fig, ax, step, name, given):
    """Particles of all materials (or of one): squares of their own size, coloured."""
    from matplotlib.collections import PolyCollection
    base, _ = scalars.split_name(name)
    cuts = [Cut(step, name, m, given) for m in materials_of(step, given, base)]
    cuts = [cut for cut in cuts if len(cut.places)]
    if not cuts:
        raise ArchiveError("no particle lies in this plane: choose another with --slice")
    black = name == "p.x"
    low, high, colours = scalars.colour_range(np.concatenate([cut.numbers for cut in cuts]))
    for cut in cuts:
        corners = 0.5 * WIDER * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        squares = cut.places[:, None] + cut.widths[:, None, None] * corners
        look = {"facecolors": "black"} if black else {"array": cut.numbers, "cmap": colours,
                                                      "clim": (low, high)}
        drawn = PolyCollection(squares, linewidths=0, rasterized=True, zorder=2, **look)
        ax.add_collection(drawn)
    set_window(ax, step, given, cuts)
    if not black:
        bar = fig.colorbar(drawn, cax=ax.inset_axes([1.03, 0, 0.035, 1]))
        bar.outline.set_linewidth(0.4)
        bar.formatter.set_powerlimits((-3, 5))


def set_window(ax, step, given, cuts):
    """The domain; or, where bodies take little of it along both axes, their surroundings."""
    first, second, _ = views.plane_axes(step, given.normal)
    level = step.levels[0]
    ends = [tuple(level.anchor[d] + n[d] * level.spacing[d] for n in (level.lower, level.upper))
            for d in (first, second)]
    places = np.concatenate([cut.places for cut in cuts])
    low, high = places.min(axis=0), places.max(axis=0)
    size = max(high - low) + 2 * max(cut.widths.max() for cut in cuts)
    if all(size < CLOSE * (end[1] - end[0]) for end in ends):
        middle = 0.5 * (low + high)
        ends = [(max(end[0], m - 0.75 * size), min(end[1], m + 0.75 * size))
                for end, m in zip(ends, middle)]
    ax.set_xlim(*ends[0])
    ax.set_ylim(*ends[1])
    ax.set_xlabel("xyz"[first])
    ax.set_ylabel("xyz"[second])
    ax.set_aspect("equal")
    ax.grid(False)


def covered_picture(places, widths):
    """(x, y, image[j, i]): 1 where particles are, 0 elsewhere, smooth between; pixels are a third
    of the particles' width."""
    pixel = max(float(np.median(widths)) / 3, 1e-300)
    reach = 4  # pixels around the particles
    low = places.min(axis=0) - reach * pixel
    counts = np.ceil((places.max(axis=0) - low) / pixel).astype(int) + reach + 1
    if counts.prod() > 4_000_000:  # bodies far apart, or very many
        pixel *= np.sqrt(counts.prod() / 4e6)
        low = places.min(axis=0) - reach * pixel
        counts = np.ceil((places.max(axis=0) - low) / pixel).astype(int) + reach + 1
    image = np.zeros(counts[::-1])
    index = np.floor((places - low) / pixel).astype(int)
    for j in range(-2, 3):
        for i in range(-2, 3):
            if i * i + j * j <= 5:
                image[index[:, 1] + j, index[:, 0] + i] = 1
    for axis in (0, 1):
        image = (np.roll(image, 1, axis) + image + np.roll(image, -1, axis)) / 3
    x, y = (low[d] + (np.arange(counts[d]) + 0.5) * pixel for d in (0, 1))
    return x, y, image


def draw_outlines(ax, step, given):
    """A line around the bodies of each material."""
    for number, material in enumerate(materials_of(step, given)):
        cut = Cut(step, "p.x", material, given)
        if not len(cut.places):
            continue
        x, y, image = covered_picture(cut.places, cut.widths)
        ax.contour(x, y, image, levels=[0.5], linewidths=0.9, zorder=5,
                   colors=[style.COLOURS[number % len(style.COLOURS)]])


def paths(archive, step, material, given, count):
    """Lines of `count` particles from the first output to this step: [n, output, 2], broken (not a
    number) where a periodic side is crossed or the particle is not there."""
    first, second, _ = views.plane_axes(step, given.normal)
    last = step.particles(material, {"p.x", "p.particleID"})
    if "p.particleID" not in last:
        raise ArchiveError("particles of this archive have no numbers (p.particleID): their paths "
                           "are not known")
    near = views.near_plane(step, last["p.x"], given.normal, given.position)
    ids = last["p.particleID"][near]
    ids = ids[np.unique(np.linspace(0, len(ids) - 1, min(count, len(ids))).astype(int))]
    numbers = [n for n, (number, _, _) in enumerate(archive.steps) if number <= step.number]
    lines = np.full((len(ids), len(numbers), 2), np.nan)
    for at, n in enumerate(numbers):
        there = archive.step(f"#{n}").particles(material, {"p.x", "p.particleID"})
        _, mine, theirs = np.intersect1d(ids, there["p.particleID"], return_indices=True)
        lines[mine, at] = there["p.x"][theirs][:, [first, second]]
    level = step.levels[0]
    half = [0.5 * (level.upper[d] - level.lower[d]) * level.spacing[d] for d in (first, second)]
    jump = (np.abs(np.diff(lines, axis=1)) > half).any(axis=2)
    lines[:, 1:][jump] = np.nan
    return lines


def draw_paths(ax, archive, step, given):
    from matplotlib.collections import LineCollection
    for number, material in enumerate(materials_of(step, given)):
        lines = paths(archive, step, material, given, given.paths)
        colour = style.COLOURS[(number + 1) % len(style.COLOURS)]
        ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=0.6, zorder=4))


def draw_line(ax, step, name, given):
    """A run in one direction: numbers against places, a material a colour."""
    base, component = scalars.split_name(name)
    direction = step.levels[0].active_directions()[0]
    every = []
    for material in materials_of(step, given, base):
        table = step.particles(material, {"p.x", "p.particleID", base})
        kept = table[base]
        numbers = scalars.scalar(base, kept.T if kept.ndim == 2 else kept, component, direction)
        ax.plot(table["p.x"][:, direction], numbers, linestyle="none",
                marker=style.MARKERS[material % len(style.MARKERS)], markersize=2.6,
                markerfacecolor="none", markeredgewidth=0.6,
                color=style.COLOURS[material % len(style.COLOURS)],
                label=f"material {material}, {len(numbers)} particles")
        every.append(numbers)
    ax.set_xlabel("xyz"[direction])
    ax.margins(x=0.01)
    return np.concatenate(every)
