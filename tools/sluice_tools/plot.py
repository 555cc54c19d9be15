"""Draw archives: profiles in 1-D, coloured planes in 2-D and 3-D, particles, histories.

    python3 -m sluice_tools.plot ARCHIVE... [options]       `sluice plot` calls this
"""
import csv
import sys

import numpy as np

from . import (histories, levels, lines, materials, options, particles, planes, quantities,
               scalars, scales, shots as all_shots, style, views)
from .archive import ArchiveError
from .plot_layout import Panels, panel_grid

USUAL = ["rho_CC", "press_CC", "vel_CC", "temp_CC"]
TALL = 1.6  # height over width from which on planes stand side by side


def usual_variables(step, material=None):
    """What is drawn where nothing is said: of the fluid, else of the particles, else of cells and
    nodes; of one material what it has."""
    def has(name):
        return step.has(name) and (material is None or name in quantities.COMMON
                                   or material in step.materials(name))
    found = [name for name in USUAL if has(name)]
    if material is not None and all(name in quantities.COMMON for name in found):
        found = []  # of a solid what it carries, not the pressure of the fluid
    found = found or [name for name in particles.usual_variables(step) if has(name)]
    if found:
        return found
    fields = [name for name in step.names()
              if step.archive.variables[name].centring in ("cell", "node") and has(name)]
    if not fields:
        raise ArchiveError("the archive holds no variable of cells or nodes to draw")
    return fields[:4]


def drawn_variables(shot, given):
    """The labels of the panels, one each."""
    if given.cmap == quantities.SCHLIEREN:
        wrong = [name for name in given.var or () if name not in
                 ("rho_CC", "sum_rho_CC", "rho_micro_CC", quantities.SCHLIEREN)]
        if wrong:
            raise ArchiveError(f"--cmap schlieren shows the gradient of a density, not of "
                               f"{wrong[0]}")
        return [quantities.SCHLIEREN]
    return given.var or usual_variables(shot.step, shot.material)


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


def plane_panel(shot, count, several):
    """(rows, columns, width, height in inches) of panels whose planes keep their proportions:
    `several` in a row, else as many as fit."""
    first, second, _ = views.plane_axes(shot.step, shot.normal)
    size = [high - low for low, high in views.domain(shot.step, (first, second))]
    tall = size[1] / size[0]
    rows, columns = (count // several, several) if several > 1 else panel_grid(count)
    if several == 1 and tall > TALL:
        rows, columns = -(-count // 4), min(count, 4)
    width = 5.5 if rows * columns == 1 else min(4.2, 12.5 / columns)
    if tall > TALL:
        width = min(width, 3.1)
        return rows, columns, width, (width - 1.6) * min(tall, 3.5) + 0.9
    return rows, columns, width, 0.75 * width * max(tall, 0.15) + 0.75


def head_text(shots, given):
    shot = shots[0]
    text = given.title or shot.archive.title()
    if len({s.archive.path for s in shots}) > 1 and not given.title:
        text = " and ".join(dict.fromkeys(s.archive.title() for s in shots))
    if len(shot.directions) == 3 and not shot.is_line:
        text += f",  {'xyz'[shot.plane_at[0]]} = {shot.plane_at[1]:.6g} m"
    steps = {(s.step.time, s.step.number) for s in shots}
    if len({time for time, _ in steps}) > 1:
        return text
    text += f"   t = {shot.step.time:.6g} s"
    return text + (f"   step {shot.step.number}" if len(steps) == 1 else "")


def material_text(shot, name):
    """Which material is drawn, where there are several."""
    if name == quantities.SCHLIEREN:
        return ""
    label = scalars.split_name(name)[0]
    there = [] if label in quantities.COMMON else shot.step.materials(label)
    if shot.material is None and (len(there) < 2 or quantities.is_of_whole(shot.step, label)):
        return ""
    if shot.material is None and (shot.is_line or label.startswith("p.")):
        return ""  # all are drawn; the legend names them
    if label in quantities.COMMON:
        return ""
    return ", " + materials.name(shot.archive,
                                 there[0] if shot.material is None else shot.material)


def caption(shot, name):
    """The title of a panel."""
    variable = shot.archive.variables[quantities.label_of(shot.step, name)]
    text = style.words(name if name == quantities.SCHLIEREN else
                       scalars.spoken(name, variable.components))
    vector = name != quantities.SCHLIEREN and variable.components == 3 and "." not in name[2:]
    if vector and name != "p.x" and (not shot.is_line or given_line(shot)):
        text = {"velocity": "speed"}.get(text, text + " magnitude")
    return text + material_text(shot, name)


def given_line(shot):
    return shot.given.line is not None


def check(shots, names, given):
    """Faults of what is asked for, before anything is drawn."""
    for shot in shots:
        for name in names:
            quantities.require(shot.step, name, shot.material)
            if shot.is_of_particles(name) and (given.radius or given.line):
                option = "--radius" if given.radius else "--line"
                raise ArchiveError(f"{option} is for variables of cells and nodes; {name} is of "
                                   "particles")
    first = shots[0]
    if given.radius and len(first.directions) == 1:
        raise ArchiveError("--radius is for runs in two or three dimensions; this one is a line")
    if first.is_line and given.particles not in (None, "none"):
        raise ArchiveError("--particles is for planes of runs in two or three dimensions")
    if len({tuple(shot.directions) for shot in shots}) > 1:
        raise ArchiveError("the archives have different dimensions: one picture cannot show both")


def draw_line_figure(shots, names, given, plt, scale_of):
    exact = read_exact(given.exact) if getattr(given, "exact", None) else None
    panels = [(name, False) for name in names]
    rows, columns = panel_grid(len(panels))
    if given.difference:
        panels = [(name, less) for name in names for less in (False, True)]
        rows, columns = len(names), 2
    figure = Panels(plt, rows, columns, 5.5 if columns == 1 else min(4.4, 11.5 / columns), 2.6,
                    given)
    for ax, (name, less) in zip(figure.axes.flat, panels):
        text = caption(shots[0], name)
        if less:
            lines.headroom(ax, lines.draw_difference(ax, shots, name))
            ax.set_xlabel(lines.x_label(shots[0]))
            lines.set_unit(ax, shots[0], name)
            text = f"{text}: {shots[1].label} - {shots[0].label}"
        else:
            lines.draw(ax, shots, name, exact, scale_of(name))
        ax.set_title(text, loc="left")
    figure.axes.flat[0].legend(loc="best", markerscale=5 if given.radius else 1)
    return figure.finish(head_text(shots, given), len(panels))


def draw_plane_figure(shots, names, given, plt, scale_of):
    in_row = len(shots) + (1 if given.difference else 0)
    figure = Panels(plt, *plane_panel(shots[0], len(names) * in_row, in_row), given)
    told, at = [], 0
    for name in names:
        for shot in shots:
            ax = figure.axes.flat[at]
            told += planes.draw(figure.fig, ax, shot, name, scale_of(name))
            text = caption(shot, name) + (f", {shot.label}" if shot.label else "")
            ax.set_title(text, loc="left")
            at += 1
        if given.difference:
            ax = figure.axes.flat[at]
            if shots[0].is_of_particles(name):
                raise ArchiveError("--difference is for variables of cells and nodes")
            planes.draw_difference(figure.fig, ax, shots, name)
            ax.set_title(f"{shots[1].label} - {shots[0].label}", loc="left")
            at += 1
    handles = planes.legend_handles(told, shots[0].archive)
    if len(shots) == 1 and len(shots[0].step.levels) > 1 and given.levels != "none":
        handles += levels.handles(shots[0].step)
    style.add_legend(figure.fig, handles)
    return figure.finish(head_text(shots, given), at)


def draw_shots(shots, given, plt, known_scales=None):
    """The figure of some shots; known_scales: {label: Scale} where these are not the only ones."""
    names = drawn_variables(shots[0], given)
    check(shots, names, given)

    def scale_of(name):
        return (known_scales or {}).get(name) or scales.of_shots(shots, name, given)
    draw = draw_line_figure if shots[0].is_line else draw_plane_figure
    return draw(shots, names, given, plt, scale_of)


def settle(given):
    """What options say of each other."""
    if given.cmap == quantities.SCHLIEREN:
        given.var = given.var or [quantities.SCHLIEREN]
    return given


def parse(arguments):
    return settle(options.parse("plot", arguments))


def draw(given, plt):
    if given.history:
        return histories.draw(given, plt)
    return draw_shots(all_shots.gather(given), given, plt)


def main(arguments=None):
    given = parse(arguments)
    return style.save_picture("sluice plot", lambda plt: draw(given, plt), given.output,
                              ArchiveError, given.dpi)


if __name__ == "__main__":
    sys.exit(main())
