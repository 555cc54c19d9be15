"""Pictures of particles: coloured by what they carry, bodies over a fluid, outlines, paths."""
import numpy as np

from . import materials, scalars, shapes, style, views
from .archive import ArchiveError

USUAL = ["p.stress", "p.velocity", "p.temperature", "p.color"]
CLOSE = 0.3  # bodies that take less of the domain along both axes are drawn from near
FINE = 5  # pixels of outlines along a particle
BELOW = 1.5  # particles lie on larger copies of themselves, cut off at the outline of the body


def base_of(name):
    return scalars.split_name(name)[0]


def is_of_particles(archive, name):
    variable = archive.variables.get(base_of(name))
    return variable is not None and variable.centring == "particle"


def usual_variables(step):
    """What is drawn of an archive of solids; nothing where it has no particles."""
    found = [name for name in USUAL if step.has(name)]
    return found or (["p.x"] if step.has("p.x") else [])


def materials_of(shot, base="p.x"):
    there = shot.step.materials(base)
    if shot.material is None:
        return there
    if shot.material not in there:
        known = ", ".join(materials.name(shot.archive, m) for m in there) or "none"
        raise ArchiveError(f"no particles of {materials.name(shot.archive, shot.material)} with "
                           f"{base}; materials that have it: {known}")
    return [shot.material]


class Cut:
    """The particles of a material that a picture shows: where its plane meets them. corners[n, 4,
    2] of their parallelograms, centres[n, 2], numbers[n] of the variable `name`."""

    def __init__(self, shot, name, material):
        base, component = scalars.split_name(name)
        table = shot.step.particles(material, {"p.x", base, *shapes.NEEDED})
        if base not in table:
            raise ArchiveError(
                f"particles of {materials.name(shot.archive, material)} have no '{base}'; there "
                f"are: {', '.join(n for n in shot.step.names() if n.startswith('p.'))}")
        self.material = material
        normal, position = shot.plane_at
        edges = shapes.edges(shot.step, material, table)
        if len(shot.directions) < 3:  # every particle lies in the plane
            places = table["p.x"].copy()
            places[:, normal] = position
        else:
            places = table["p.x"]
        met, self.corners = shapes.sections(places, edges, normal, position)
        first, second, _ = views.plane_axes(shot.step, normal)
        self.centres = table["p.x"][met][:, [first, second]]
        kept = table[base][met]
        self.numbers = scalars.scalar(base, kept.T if kept.ndim == 2 else kept, component)
        self._covered = None

    def covered(self):
        if self._covered is None:
            self._covered = covered_picture(self.corners)
        return self._covered


def add_particles(ax, cut, **look):
    """Parallelograms with hard edges, over larger ones that are cut off at the outline of the
    body: so that gaps between particles that moved apart have the colour of a neighbour."""
    from matplotlib.collections import PolyCollection
    look = {"linewidths": 0, "antialiaseds": False, "rasterized": True, **look}
    middle = cut.corners.mean(axis=1, keepdims=True)
    below = ax.add_collection(PolyCollection(middle + BELOW * (cut.corners - middle), **look))
    x, y, image = cut.covered()
    outline = ax.contour(x, y, image, levels=[0.5], linewidths=0)
    below.set_clip_path(_joined(outline), ax.transData)
    for part in outline.collections:
        part.remove()
    return ax.add_collection(PolyCollection(cut.corners, **look))


def add_tracers(ax, cut, **look):
    """Points: what a fluid carries has no size."""
    return ax.scatter(cut.centres[:, 0], cut.centres[:, 1], s=3, linewidths=0, zorder=4, **look)


def solids(shot):
    """Materials with particles that are pieces of a body."""
    return [m for m in shot.step.particle_materials() if not materials.is_fluid(shot.archive, m)]


def _joined(outline):
    """All lines of a contour as one path."""
    from matplotlib.path import Path
    paths_of = [path for part in outline.collections for path in part.get_paths()]
    return Path.make_compound_path(*paths_of) if paths_of else Path(np.zeros((3, 2)))


def draw_panel(ax, shot, name, scale):
    """Particles of all materials (or of one), coloured; the collection that a colour bar shows."""
    cuts = [cut for cut in shot.cuts(name) if len(cut.corners)]
    if not cuts:
        raise ArchiveError("no particle lies in this plane: choose another with --slice")
    drawn = None
    for cut in cuts:
        look = {"array": cut.numbers, "cmap": scale.colours, "norm": scale.norm()}
        if name == "p.x":
            look = {"facecolors": style.solid_colour(cut.material)}
        drawn = add_particles(ax, cut, zorder=2, **look)
    ends = shot.window or window_of(shot, cuts)
    ax.set_xlim(*ends[0])
    ax.set_ylim(*ends[1])
    return None if name == "p.x" else drawn


def window_of(shot, cuts):
    """[(low, high)] of both axes: the domain; or, where bodies take little of it along both axes,
    their surroundings."""
    first, second, _ = views.plane_axes(shot.step, shot.normal)
    ends = views.domain(shot.step, (first, second))
    corners = np.concatenate([cut.corners.reshape(-1, 2) for cut in cuts])
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = max(high - low)
    if all(size < CLOSE * (end[1] - end[0]) for end in ends):
        middle = 0.5 * (low + high)
        ends = [(max(end[0], m - 0.75 * size), min(end[1], m + 0.75 * size))
                for end, m in zip(ends, middle)]
    return ends


def covered_picture(corners):
    """(x, y, image[j, i]): 1 where parallelograms corners[n, 4, 2] are, 0 elsewhere, smooth
    between; gaps up to half as wide as a parallelogram are closed. Pixels are a fraction of the
    parallelograms' width."""
    from PIL import Image, ImageDraw, ImageFilter
    sides = [np.linalg.norm(corners[:, n] - corners[:, 0], axis=1) for n in (1, 3)]
    pixel = max(float(np.median(np.minimum(*sides))) / FINE, 1e-300)
    reach = 4  # pixels around the particles
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    counts = np.ceil((high - low) / pixel).astype(int) + 2 * reach
    if counts.prod() > 4_000_000:  # bodies far apart, or very many
        pixel *= np.sqrt(counts.prod() / 4e6)
        counts = np.ceil((high - low) / pixel).astype(int) + 2 * reach
    low = low - reach * pixel
    image = Image.new("L", tuple(int(n) for n in counts))
    draw = ImageDraw.Draw(image)
    for polygon in (corners - low) / pixel - 0.5:
        draw.polygon([tuple(corner) for corner in polygon], fill=255)
    image = image.filter(ImageFilter.MaxFilter(3)).filter(ImageFilter.MinFilter(3))
    image = np.asarray(image, dtype=float) / 255
    for axis in (0, 1):
        image = (np.roll(image, 1, axis) + image + np.roll(image, -1, axis)) / 3
    x, y = (low[d] + (np.arange(counts[d]) + 0.5) * pixel for d in (0, 1))
    return x, y, image


def draw_outlines(ax, shot, colour_of=style.solid_colour, width=0.9):
    """A line around the bodies of each material."""
    for material in materials_of(shot):
        cut = _cut_of(shot, material)
        if materials.is_fluid(shot.archive, material) or cut is None or not len(cut.corners):
            continue
        x, y, image = cut.covered()
        ax.contour(x, y, image, levels=[0.5], linewidths=width, zorder=5,
                   colors=[colour_of(material)])


def _cut_of(shot, material):
    return next((cut for cut in shot.cuts("p.x") if cut.material == material), None)


def draw_bodies(ax, shot):
    """Solids over a fluid: each in the colour of its material, with a dark outline; the materials
    that are drawn."""
    drawn = []
    for cut in shot.cuts("p.x"):
        if not len(cut.corners):
            continue
        if materials.is_fluid(shot.archive, cut.material):
            add_tracers(ax, cut, color="black")
            continue
        add_particles(ax, cut, zorder=4, facecolors=style.solid_colour(cut.material))
        drawn.append(cut.material)
    draw_outlines(ax, shot, lambda material: "black", 0.6)
    return drawn


def draw_coloured(fig, ax, shot, name, scale):
    """Particles over a plane, coloured by what they carry, with a colour bar below."""
    base, _ = scalars.split_name(name)
    cuts = [cut for cut in shot.cuts(name) if len(cut.corners)]
    if not cuts:
        return
    look = {"cmap": "magma" if scale.colours == "cividis" else scale.colours,
            "norm": scale.norm()}
    for cut in cuts:
        if materials.is_fluid(shot.archive, cut.material):
            drawn = add_tracers(ax, cut, c=cut.numbers, **look)
        else:
            drawn = add_particles(ax, cut, zorder=4, array=cut.numbers, **look)
    bar = fig.colorbar(drawn, ax=ax, orientation="horizontal", aspect=30, pad=0.02, shrink=0.8)
    bar.outline.set_linewidth(0.4)
    bar.set_label(style.with_unit(name, shot.archive.variables[base].unit))


def paths(shot, material, count):
    """Lines of `count` particles from the first output to this step: [n, output, 2], broken (not a
    number) where a periodic side is crossed or the particle is not there."""
    step, archive = shot.step, shot.archive
    first, second, _ = views.plane_axes(step, shot.normal)
    last = step.particles(material, {"p.x", "p.particleID"})
    if "p.particleID" not in last:
        raise ArchiveError("particles of this archive have no numbers (p.particleID): their paths "
                           "are not known")
    near = views.near_plane(step, last["p.x"], shot.normal, shot.position)
    ids = last["p.particleID"][near]
    ids = ids[np.unique(np.linspace(0, len(ids) - 1, min(count, len(ids))).astype(int))]
    numbers = [n for n, (number, _, _) in enumerate(archive.steps) if number <= step.number]
    lines = np.full((len(ids), len(numbers), 2), np.nan)
    for at, n in enumerate(numbers):
        there = archive.step(f"#{n}").particles(material, {"p.x", "p.particleID"})
        _, mine, theirs = np.intersect1d(ids, there["p.particleID"], return_indices=True)
        lines[mine, at] = there["p.x"][theirs][:, [first, second]]
    half = [0.5 * (high - low) for low, high in views.domain(step, (first, second))]
    jump = (np.abs(np.diff(lines, axis=1)) > half).any(axis=2)
    lines[:, 1:][jump] = np.nan
    return lines


def draw_paths(ax, shot):
    from matplotlib.collections import LineCollection
    for number, material in enumerate(materials_of(shot)):
        lines = paths(shot, material, shot.given.paths)
        colour = style.COLOURS[(number + 1) % len(style.COLOURS)]
        ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=0.6, zorder=4))


def line(shot, name):
    """Of a run in one direction: (material, places, numbers) of each material."""
    base, component = scalars.split_name(name)
    direction = shot.directions[0]
    for material in materials_of(shot, base):
        table = shot.step.particles(material, {"p.x", base})
        kept = table[base]
        numbers = scalars.scalar(base, kept.T if kept.ndim == 2 else kept, component, direction)
        order = np.argsort(table["p.x"][:, direction], kind="stable")
        yield material, table["p.x"][order, direction], numbers[order]


def spans(shot, material):
    """Of a run in one direction: [(low, high)] where bodies of a material are, m."""
    direction = shot.directions[0]
    table = shot.step.particles(material, {"p.x", *shapes.NEEDED})
    half = 0.5 * shapes.OVERLAP * np.abs(shapes.edges(shot.step, material, table)[:, direction])
    places, half = table["p.x"][:, direction], half.sum(axis=1)
    joined = []
    for low, high in sorted(zip(places - half, places + half)):
        if joined and low <= joined[-1][1]:
            joined[-1][1] = max(joined[-1][1], high)
        else:
            joined.append([low, high])
    return [tuple(span) for span in joined]
