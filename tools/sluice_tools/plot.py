"""Draw an archive: profiles in 1-D, coloured slices in 2-D and 3-D, particles, histories.

    python3 -m sluice_tools.plot ARCHIVE [options]       `sluice plot` calls this
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

from . import levels, particles, scalars, style, views
from .archive import Archive, ArchiveError

USUAL = ["rho_CC", "press_CC", "vel_CC", "temp_CC"]


def usual_variables(step):
    found = [name for name in USUAL if step.has(name)]
    found = found or particles.usual_variables(step)
    if found:
        return found
    fields = [name for name in step.names()
              if step.archive.variables[name].centring in ("cell", "node")]
    if not fields:
        raise ArchiveError("the archive holds no variable of cells or nodes to draw")
    return fields[:4]


def read_exact(path):
    """Columns of a CSV file by name: x first, then one a variable; lines with # are comments."""
    try:
        with open(path, encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        columns = np.array([[float(cell) for cell in row] for row in rows[1:]]).T
        return dict(zip(rows[0], columns))
    except (OSError, ValueError, IndexError) as error:
        raise ArchiveError(f"{path}: no exact solution can be read here ({error}); expected a "
                           "CSV file with the header x,NAME,... and numbers") from error


def panel_grid(count):
    columns = 1 if count == 1 else 2 if count <= 4 else 3
    return -(-count // columns), columns


def unit_of(archive, name):
    return archive.variables[scalars.split_name(name)[0]].unit


def profiles_of_materials(step, name, material):
    """[(material or None, profiles)]: the material that is asked for; else all that differ, each
    where it is."""
    there = step.materials(scalars.split_name(name)[0])
    if material is not None or len(there) < 2:
        return [(None, list(views.profiles(step, name, material)))]
    found = [(m, list(views.profiles(step, name, m))) for m in there]
    first = found[0][1]
    if all(np.array_equal(a[2], b[2], equal_nan=True)
           for _, parts in found[1:] for a, b in zip(first, parts)):
        return [(None, first)]
    return [(m, where_present(step, m, parts)) for m, parts in found]


def where_present(step, material, parts):
    if material not in (step.materials("rho_CC") if step.has("rho_CC") else []):
        return parts
    mass = views.profiles(step, "rho_CC", material)
    return [(level, x, np.where(rho == 0, np.nan, values) if rho.shape == values.shape else values,
             hidden) for (level, x, values, hidden), (_, _, rho, _) in zip(parts, mass)]


def draw_line(ax, step, name, given, exact):
    """All materials and levels, the finest on top; what a finer level covers is drawn faintly."""
    levels.draw_bands(ax, step, given.levels)
    drawn = profiles_of_materials(step, name, given.material)
    parts = [part for _, of_material in drawn for part in of_material]
    owners = [m for m, of_material in drawn for _ in of_material]
    cells = [np.isfinite(values).sum() for _, _, values, _ in parts]
    many = max(cells) > 600
    one_level = len(step.levels) == 1
    for (level, x, values, hidden), count, material in zip(parts, cells, owners):
        text = f"{count} cells" if one_level else f"level {level}, {count} cells"
        text = text if material is None else f"material {material}, {text}"
        series = material if one_level and material is not None else level
        marker = style.MARKERS[(material or series) % len(style.MARKERS)]
        look = {"color": levels.colour(series), "zorder": 2.1 + 0.1 * level}
        look |= {"linewidth": 1.1} if many else {
            "linestyle": "none", "marker": marker, "markersize": 2.6, "markerfacecolor": "none",
            "markeredgewidth": 0.6}
        ax.plot(x, np.where(hidden, np.nan, values), label=text, **look)
        if hidden.any():
            ax.plot(x, np.where(hidden, values, np.nan), alpha=0.3, **look)
    if exact is not None and name in exact:
        ax.plot(exact["x"], exact[name], color="black", linewidth=0.9, label="exact", zorder=3)
    ax.set_xlabel("xyz"[step.levels[0].active_directions()[0]])
    ax.margins(x=0.01)
    headroom(ax, np.concatenate([values[np.isfinite(values)] for _, _, values, _ in parts]))


def draw_radius(ax, step, name, given, exact):
    """Every cell against its distance from the origin, the finest level there is."""
    parts = list(views.radii(step, name, given.material))
    for level, radius, values in parts:
        ax.plot(radius, values, linestyle="none", marker=style.MARKERS[level % len(style.MARKERS)],
                markersize=1.2, markeredgewidth=0, color=levels.colour(level), rasterized=True,
                label=f"level {level}, {len(values)} cells")
    if exact is not None and name in exact:
        ax.plot(exact["x"], exact[name], color="black", linewidth=0.9, label="exact", zorder=3)
    ax.set_xlabel("distance from the origin")
    ax.margins(x=0.01)
    headroom(ax, np.concatenate([values for _, _, values in parts]))


def headroom(ax, values):
    """A field that is constant to round-off is drawn as a constant, not as its noise."""
    low, high = float(np.min(values)), float(np.max(values))
    size = max(abs(low), abs(high))
    if high - low <= 1e-9 * size or size == 0:
        pad = 0.1 * size or 1.0
        ax.set_ylim(low - pad, high + pad)
    ax.ticklabel_format(axis="y", useOffset=False, style="sci", scilimits=(-3, 5))


def colour_range(sheets):
    return scalars.colour_range(np.concatenate(
        [sheet[~hidden & np.isfinite(sheet)] for *_, sheet, hidden in sheets]))


def draw_plane(fig, ax, step, name, given):
    """Cells of every level, finer ones over coarser ones, then the lines of the levels."""
    sheets = views.plane(step, name, given.material, given.normal, given.position)
    low, high, colours = colour_range(sheets)
    for xs, ys, sheet, _ in sheets:
        image = ax.pcolormesh(xs, ys, np.ma.masked_invalid(sheet), vmin=low, vmax=high,
                              cmap=colours, rasterized=True)
    levels.draw_plane_lines(ax, step, given.levels, given.normal, given.position)
    first, second, _ = views.plane_axes(step, given.normal)
    ax.set_xlabel("xyz"[first])
    ax.set_ylabel("xyz"[second])
    ax.set_aspect("equal")
    ax.grid(False)
    # Inset, so that the bar is as high as a plane drawn in its own proportions.
    bar = fig.colorbar(image, cax=ax.inset_axes([1.03, 0, 0.035, 1]))
    bar.outline.set_linewidth(0.4)
    bar.formatter.set_powerlimits((-3, 5))


def draw_particles(fig, ax, step, given):
    """Particles over a plane: points, coloured by what they carry where that is asked for."""
    first, second, _ = views.plane_axes(step, given.normal)
    base, component = scalars.split_name(given.particles)
    tables = [step.particles(m) for m in particles.materials_of(step, given)]
    if not any(base in table for table in tables):
        names = sorted({name for table in tables for name in table})
        raise ArchiveError(f"particles have no '{base}'; there are: {', '.join(names)}")
    places, numbers = [], []
    for table in tables:
        if base not in table:
            continue
        near = views.near_plane(step, table["p.x"], given.normal, given.position)
        places.append(table["p.x"][near])
        numbers.append(scalars.scalar(base, table[base].T, component)[near])
    places = np.concatenate(places)
    look = {"s": 3, "linewidths": 0, "zorder": 4}
    if given.particles == "p.x":
        ax.scatter(places[:, first], places[:, second], color="black", **look)
        return
    points = ax.scatter(places[:, first], places[:, second], cmap="magma",
                        c=np.concatenate(numbers), **look)
    bar = fig.colorbar(points, ax=ax, orientation="horizontal", aspect=30, pad=0.02)
    bar.outline.set_linewidth(0.4)
    unit = step.archive.variables[base].unit
    bar.set_label(given.particles + ("" if unit in ("", "1") else f"  ({style.unit_text(unit)})"))


def draw_particle_panel(fig, ax, step, name, given):
    if given.radius:
        raise ArchiveError(f"--radius is for variables of cells and nodes; {name} is of particles")
    if len(step.levels[0].active_directions()) == 1:
        headroom(ax, particles.draw_line(ax, step, name, given))
        return
    particles.draw_panel(fig, ax, step, name, given)
    levels.draw_plane_lines(ax, step, given.levels, given.normal, given.position)


def draw_over(ax, archive, step, given):
    """What may lie over any plane."""
    if given.outline:
        particles.draw_outlines(ax, step, given)
    if given.paths:
        particles.draw_paths(ax, archive, step, given)


def plane_height(step, given, width):
    """Height of a panel of this width (inches) whose plane keeps its proportions."""
    level = step.levels[0]
    first, second, _ = views.plane_axes(step, given.normal)
    size = [(level.upper[d] - level.lower[d]) * level.spacing[d] for d in (first, second)]
    return 0.75 * width * min(max(size[1] / size[0], 0.15), 1.6) + 0.75


def head_text(archive, step, given):
    text = given.title or archive.title()
    if given.position is not None and given.normal is not None:
        text += f",  {'xyz'[given.normal]} = {given.position:g}"
    return f"{text}   t = {step.time:.6g}   step {step.number}"


def material_text(step, name, given):
    """Which material is drawn, where there are several."""
    label = scalars.split_name(name)[0]
    there = [] if label in style.COMMON else step.materials(label)
    line = len(step.levels[0].active_directions()) == 1 and not given.radius
    if len(there) < 2 or (line and given.material is None):
        return ""  # lines of all materials are told in the legend
    if label.startswith("p.") and given.material is None:
        return ""  # particles of all are drawn
    return f", material {there[0] if given.material is None else given.material}"


def draw_fields(archive, given, plt):
    step = archive.step(given.time)
    names = given.var or usual_variables(step)
    for name in names:
        views.stored_levels(step, scalars.split_name(name)[0], given.material)  # told first
    line = len(step.levels[0].active_directions()) == 1
    if given.radius and line:
        raise ArchiveError("--radius is for runs in two or three dimensions; this one is a line")
    one = line or given.radius
    if given.particles and one:
        raise ArchiveError("--particles is for planes of runs in two or three dimensions")
    exact = read_exact(given.exact) if given.exact else None
    rows, columns = panel_grid(len(names))
    width = 5.5 if len(names) == 1 and not one else min(4.0, 11.0 / columns)
    height = 2.5 if one else plane_height(step, given, width)
    fig, axes = plt.subplots(rows, columns, squeeze=False,
                             figsize=(width * columns, height * rows + 0.3))
    for ax, name in zip(axes.flat, names):
        if particles.is_of_particles(archive, name):
            draw_particle_panel(fig, ax, step, name, given)
        elif given.radius:
            draw_radius(ax, step, name, given, exact)
        elif one:
            draw_line(ax, step, name, given, exact)
        else:
            draw_plane(fig, ax, step, name, given)
            if given.particles:
                draw_particles(fig, ax, step, given)
        if not one:
            draw_over(ax, archive, step, given)
        base, component = scalars.split_name(name)
        components = archive.variables[base].components
        caption = style.caption(scalars.spoken(name, components), unit_of(archive, name))
        if not one and component is None and components == 3 and name != "p.x":
            caption = caption.replace("  (", " magnitude  (")
        ax.set_title(caption + material_text(step, name, given), loc="left")
    for ax in axes.flat[len(names):]:
        ax.set_visible(False)
    if one:
        axes.flat[0].legend(loc="best", markerscale=5 if given.radius else 1)
    elif len(step.levels) > 1 and given.levels != "none":
        levels.add_legend(fig, step)
    fig.suptitle(head_text(archive, step, given), x=0.01, ha="left", fontsize=11)
    return fig


def draw_level_cells(ax, archive):
    """Cells of each level over time, each until the next line of levels.txt."""
    table = archive.level_cells()
    for level, cells in enumerate(table[:, 2:].T):
        ax.step(table[:, 1], cells, where="post", color=levels.colour(level),
                linestyle=style.LINES[level % len(style.LINES)], label=f"level {level}")
    ax.set_title("cells of each level", loc="left")
    ax.set_xlabel("time")
    ax.legend()
    headroom(ax, table[:, 2:])


def draw_histories(archive, given, plt):
    rows, columns = panel_grid(len(given.history))
    fig, axes = plt.subplots(rows, columns, squeeze=False,
                             figsize=(4.0 * columns, 2.5 * rows + 0.3))
    for ax, name in zip(axes.flat, given.history):
        if name == "levels":
            draw_level_cells(ax, archive)
            continue
        along, places, values = archive.history(name)
        for c, column in enumerate(values.T):
            ax.plot(places, column, color=style.COLOURS[c], linestyle=style.LINES[c],
                    label="xyz"[c])
        if len(values.T) > 1:
            ax.legend()
        ax.set_title(name, loc="left")
        ax.set_xlabel(along)
        headroom(ax, values)
    for ax in axes.flat[len(given.history):]:
        ax.set_visible(False)
    fig.suptitle(given.title or archive.title(), x=0.01, ha="left", fontsize=11)
    return fig


def parse_slice(text):
    axis, equals, position = text.partition("=")
    try:
        if axis not in ("x", "y", "z") or not equals:
            raise ValueError
        return "xyz".index(axis), float(position)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}': write x=0.5, y=... or z=...") from None


def parse(arguments):
    parser = argparse.ArgumentParser(prog="sluice plot", description="Draw an archive")
    parser.add_argument("archive")
    parser.add_argument("--var", action="append",
                        help="label, or a component: vel_CC.x, p.stress.xy")
    parser.add_argument("--material", type=int)
    parser.add_argument("--time", default="last", help="last, first, #N or a time")
    parser.add_argument("--slice", type=parse_slice, help="plane of a 3-D run, z=0.5 (middle)")
    parser.add_argument("--radius", action="store_true",
                        help="every cell of a 2-D or 3-D run against its distance from the origin")
    parser.add_argument("--levels", choices=levels.KINDS, default=levels.KINDS[0],
                        help="what is drawn of finer levels: their outer edges (default), their "
                        "boxes, the tiles of the regridder, or none of it")
    parser.add_argument("--history", action="append", help="a .dat file by its label; levels: the "
                        "cells of each level over time")
    parser.add_argument("--exact", help="CSV with x and one column per variable, drawn as a line")
    parser.add_argument("--particles", help="particles over the plane, coloured by this label of "
                        "theirs; p.x: in black")
    parser.add_argument("--outline", action="store_true", help="lines around the bodies of each "
                        "material over planes")
    parser.add_argument("--paths", type=int, metavar="N", help="paths of N particles of each "
                        "material from the first output on")
    parser.add_argument("--title")
    parser.add_argument("-o", "--output", default="picture.png", help=".png, .svg or .pdf")
    given = parser.parse_args(arguments)
    given.normal, given.position = given.slice or (None, None)
    if pathlib.Path(given.output).suffix not in (".png", ".svg", ".pdf"):
        parser.error(f"'{given.output}': the name of a picture ends in .png, .svg or .pdf")
    return given


def main(arguments=None):
    given = parse(arguments)
    draw = draw_histories if given.history else draw_fields
    return style.save_picture("sluice plot", lambda plt: draw(Archive(given.archive), given, plt),
                              given.output, ArchiveError)


if __name__ == "__main__":
    sys.exit(main())
