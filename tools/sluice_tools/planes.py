"""A panel that shows a plane: cells of every level, materials where they are, and what lies over
them (solids, interfaces, lines of equal value, arrows, edges of levels)."""
import numpy as np

from . import levels, materials, particles, quantities, style, views
from .archive import ArchiveError

INTERFACES = ["#000000", "#D55E00", "#CC79A7", "#009E73", "#56B4E9"]


def casing(width):
    """A white rim, so that a line shows on any colour."""
    from matplotlib.patheffects import withStroke
    return [withStroke(linewidth=width + 0.8, foreground="white", alpha=0.7)]


def set_axes(ax, shot):
    first, second, _ = views.plane_axes(shot.step, shot.normal)
    ax.set_xlabel("xyz"[first] + "  (m)")
    ax.set_ylabel("xyz"[second] + "  (m)")
    ax.set_aspect("equal")
    ax.grid(False)


def draw_cells(ax, shot, name, scale):
    """Cells of every level, finer ones over coarser ones; the image that a colour bar shows."""
    first, second, _ = views.plane_axes(shot.step, shot.normal)
    image = None
    for xs, ys, sheet, hidden in shot.sheets(name):
        cells = np.ma.masked_invalid(np.where(hidden, np.nan, scale.shown(sheet)))
        image = ax.imshow(cells, origin="lower", extent=(xs[0], xs[-1], ys[0], ys[-1]),
                          interpolation="nearest", aspect="equal", cmap=scale.colours,
                          norm=scale.norm(), zorder=1)
    ends = views.domain(shot.step, (first, second))
    ax.set_xlim(*ends[0])
    ax.set_ylim(*ends[1])
    return image


def _share_sheets(shot, material):
    """Volume fractions of a material in the plane, level by level as views.plane gives them."""
    first, second, normal = views.plane_axes(shot.step, shot.normal)
    sheets = []
    stored = [level for name, m, level in shot.step.stored() if name == "rho_CC" and m == material]
    stored = stored or [level for name, m, level in shot.step.stored()
                        if name == "vol_frac_CC" and m == material]
    for at, level in enumerate(stored):
        field = quantities.share(shot.step, material, level)
        index = views.layer(shot.step.levels[level], normal, shot.position) - field.lower[normal]
        if not 0 <= index < field.values.shape[normal]:
            continue
        finer = stored[at + 1] if at + 1 < len(stored) else 1 << 30
        hidden = views.covered(shot.step, level, field.values.shape, field.lower, finer)
        sheets.append((views.edges_of(field, first), views.edges_of(field, second),
                       np.take(field.values, index, axis=normal).T,
                       np.take(hidden, index, axis=normal).T))
    return sheets


def interfaces(shot):
    """[(material, x, y, share[j, i])] of the fluids in the plane, the one that takes most of it
    left out; shares reach to the edges of the plane."""
    found = []
    fluids = quantities.fluids(shot.step)
    for material in fluids if len(fluids) > 1 else ():
        sheets = _share_sheets(shot, material)
        if not sheets:
            continue
        x, y, share = views.composed(sheets)
        x = np.concatenate([[1.5 * x[0] - 0.5 * x[1]], x, [1.5 * x[-1] - 0.5 * x[-2]]])
        y = np.concatenate([[1.5 * y[0] - 0.5 * y[1]], y, [1.5 * y[-1] - 0.5 * y[-2]]])
        found.append((material, x, y, np.pad(np.nan_to_num(share), 1, mode="edge")))
    most = max(found, key=lambda part: part[3].sum(), default=None)
    return [part for part in found if part is not most]


def draw_interfaces(ax, shot):
    """Lines where half of a cell is of a material; the materials that are drawn."""
    drawn = []
    for number, (material, x, y, share) in enumerate(interfaces(shot)):
        if share.min() >= 0.5 or share.max() <= 0.5:
            continue
        lines = ax.contour(x, y, share, levels=[0.5], linewidths=0.9, zorder=3,
                           colors=[INTERFACES[number % len(INTERFACES)]])
        for part in lines.collections:
            part.set_path_effects(casing(0.9))
        drawn.append((material, INTERFACES[number % len(INTERFACES)]))
    return drawn


def draw_contours(ax, shot, name, scale):
    x, y, values = views.composed(shot.sheets(name))
    wanted = shot.given.contours
    if isinstance(wanted, int):
        wanted = (np.geomspace if scale.log else np.linspace)(scale.low, scale.high, wanted + 2)
        wanted = wanted[1:-1]
    inside = [v for v in wanted if np.nanmin(values) < v < np.nanmax(values)]
    if inside:
        ax.contour(x, y, np.ma.masked_invalid(values), levels=inside, colors="black",
                   linewidths=0.5, zorder=3)


def draw_arrows(ax, shot):
    """The velocity of the whole (or of the material asked for), at places evenly apart."""
    label = next((name for name in ("vel_CC", "g.velocity") if shot.step.has(name)), None)
    if label is None:
        raise ArchiveError("--arrows needs a saved velocity: vel_CC or g.velocity")
    first, second, _ = views.plane_axes(shot.step, shot.normal)
    parts = [views.composed(shot.sheets(f"{label}.{'xyz'[d]}")) for d in (first, second)]
    x, y, _ = parts[0]
    apart = max(x[-1] - x[0], y[-1] - y[0]) / shot.given.arrows
    places = [np.arange(axis[0] + 0.5 * apart, axis[-1], apart) for axis in (x, y)]
    i, j = (np.clip(np.searchsorted(axis, where), 0, len(axis) - 1)
            for axis, where in zip((x, y), places))
    u, v = (part[2][np.ix_(j, i)] for part in parts)
    most = np.nanmax(np.hypot(u, v), initial=0)
    if most > 0:
        ax.quiver(x[i], y[j], u / most, v / most, angles="xy", scale_units="xy", color="black",
                  scale=1 / (1.2 * apart), width=0.0025, zorder=6)


def draw(fig, ax, shot, name, scale, bar=True):
    """One panel; what its legend tells: [(material, colour, is a line)]."""
    told = []
    of_particles = shot.is_of_particles(name)
    if of_particles:
        drawn = particles.draw_panel(ax, shot, name, scale)
        several = [cut.material for cut in shot.cuts(name) if len(cut.corners)]
        if name == "p.x":
            told = [(m, style.solid_colour(m), False) for m in several]
        elif len(several) > 1:
            particles.draw_outlines(ax, shot)
            told = [(m, style.solid_colour(m), True) for m in several]
    else:
        drawn = draw_cells(ax, shot, name, scale)
        told = draw_over_cells(fig, ax, shot, name, scale)
    set_axes(ax, shot)
    given = shot.given
    if given.outline and not (of_particles and told and told[0][2]):
        particles.draw_outlines(ax, shot)
    if given.paths:
        particles.draw_paths(ax, shot)
    levels.draw_plane_lines(ax, shot.step, given.levels, shot.normal, shot.position)
    if bar and drawn is not None:
        bar = style.colour_bar(fig, ax, drawn, quantities.unit_of(shot.step, name))
        if scale.schlieren:  # its scale is crowded at the dark end
            bar.set_ticks([share * scale.high for share in (0, 0.05, 0.1, 0.2, 0.4)])
    return told


def draw_over_cells(fig, ax, shot, name, scale):
    told, given = [], shot.given
    if shot.material is None and name != quantities.SCHLIEREN:
        told += [(m, colour, True) for m, colour in draw_interfaces(ax, shot)]
    if given.contours:
        draw_contours(ax, shot, name, scale)
    if given.arrows:
        draw_arrows(ax, shot)
    label = given.particles or ("p.x" if shot.step.particle_materials() else "none")
    if label == "none":
        return told
    if label != "p.x":
        particles.draw_coloured(fig, ax, shot, label)
    elif shot.material is None or shot.material in shot.step.particle_materials():
        told += [(m, style.solid_colour(m), False) for m in particles.draw_bodies(ax, shot)]
    return told


def legend_handles(told, archive):
    """Of [(material, colour, is a line)] in the order in which they come, each once."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    handles = []
    for material, colour, is_line in dict.fromkeys(told):
        label = materials.name(archive, material)
        handles.append(Line2D([], [], color=colour, linewidth=1.2, label=label) if is_line else
                       Patch(color=colour, label=label))
    return handles


def draw_difference(fig, ax, shots, name):
    """The second shot less the first, on the finest cells of the first in the plane."""
    from .scales import Scale
    x, y, first = views.composed(shots[0].sheets(name))
    other_x, other_y, second = views.composed(shots[1].sheets(name))
    at = []
    for mine, theirs in ((x, other_x), (y, other_y)):
        step = theirs[1] - theirs[0] if len(theirs) > 1 else 1.0
        index = np.floor((mine - theirs[0]) / step + 0.5).astype(int)
        at.append(np.where((index >= 0) & (index < len(theirs)), index, -1))
    values = second[np.ix_(np.maximum(at[1], 0), np.maximum(at[0], 0))] - first
    values[at[1] < 0] = np.nan
    values[:, at[0] < 0] = np.nan
    known = values[np.isfinite(values)]
    size = float(np.abs(known).max()) if len(known) else 0.0
    noise = 1e-14 * float(np.nanmax(np.abs(first))) if np.isfinite(first).any() else 0.0
    size = size if size > noise else max(noise, 1e-300) * 10
    scale = Scale(-size, size, "PuOr")
    half = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    image = ax.imshow(np.ma.masked_invalid(values), origin="lower", interpolation="nearest",
                      extent=(x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1]),
                      cmap=scale.colours, norm=scale.norm())
    set_axes(ax, shots[0])
    style.colour_bar(fig, ax, image, quantities.unit_of(shots[0].step, name))
