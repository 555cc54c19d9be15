"""A panel that shows profiles: along a run in one direction, along a line through another, by the
distance from the origin; of several archives or times over each other."""
import numpy as np

from . import levels, materials, particles, quantities, scalars, style, views

MANY = 600  # values from which on they are drawn as a line without markers


def headroom(ax, values, size=0.0):
    """A field that is constant to round-off is drawn as a constant, not as its noise."""
    values = values[np.isfinite(values)]
    if not len(values):
        return
    low, high = float(np.min(values)), float(np.max(values))
    largest = max(abs(low), abs(high), size)
    if high - low <= scalars.ROUND_OFF * largest or largest == 0:
        pad = 0.1 * largest or 1.0
        ax.set_ylim(low - pad, high + pad)
    ax.ticklabel_format(axis="y", useOffset=False, style="sci", scilimits=(-3, 5))


def _look(count, series, level=0):
    look = {"color": levels.colour(series), "zorder": 2.1 + 0.1 * level}
    if count > MANY:
        return look | {"linewidth": 1.1}
    return look | {"linestyle": "none", "marker": style.MARKERS[series % len(style.MARKERS)],
                   "markersize": 2.6, "markerfacecolor": "none", "markeredgewidth": 0.6}


def draw_levels(ax, shot, name):
    """All materials and levels, the finest on top; what a finer level covers is drawn faintly."""
    from .shots import line_materials
    step = shot.step
    levels.draw_bands(ax, step, shot.given.levels)
    shown = line_materials(step, name, shot.material)
    for material in shown:
        for level, x, values, hidden in views.profiles(step, name, material):
            count = np.isfinite(values).sum()
            words = [materials.name(shot.archive, material)] if len(shown) > 1 else []
            words += [f"level {level}"] if len(step.levels) > 1 else []
            series = material if len(step.levels) == 1 and len(shown) > 1 else level
            look = _look(count, series, level)
            if len(step.levels) > 1 and len(shown) > 1 and count <= MANY:
                look["marker"] = style.MARKERS[material % len(style.MARKERS)]
            ax.plot(x, np.where(hidden, np.nan, values), **look,
                    label=", ".join([*words, f"{count} cells"]))
            if hidden.any():
                ax.plot(x, np.where(hidden, values, np.nan), alpha=0.3, **look)


def draw_particles(ax, shot, name):
    for material, x, numbers in shot.lines(name):
        ax.plot(x, numbers, label=f"{materials.name(shot.archive, material)}, {len(numbers)} "
                "particles", **_look(0, material))


def draw_radius(ax, shot, name, several):
    """Every cell against its distance from the origin, the finest level there is."""
    for level, radius, values in views.radii(shot.step, name, shot.material):
        series = shot.number if several else level
        told = shot.label if several else f"level {level}, {len(values)} cells"
        ax.plot(radius, values, linestyle="none", marker=style.MARKERS[level % len(style.MARKERS)],
                markersize=1.2, markeredgewidth=0, color=levels.colour(series), rasterized=True,
                label=told if not several or level == 0 else "_")


def colour_of(number, count):
    """Of one of several lines: from the palette, of many along a map."""
    if count <= len(style.COLOURS):
        return style.COLOURS[number]
    import matplotlib
    return matplotlib.colormaps["viridis"](number / (count - 1) * 0.9)


def draw_several(ax, shots, name):
    """Each shot a line of its own colour; its materials by their style."""
    for number, shot in enumerate(shots):
        shown = shot.lines(name)
        for n, (material, x, values) in enumerate(shown):
            words = [shot.label] if shot.label else []
            words += [materials.name(shot.archive, material)] if len(shown) > 1 else []
            ax.plot(x, values, color=colour_of(number, len(shots)), linewidth=1.1,
                    linestyle=style.LINES[n % len(style.LINES)],
                    marker="." if shot.is_of_particles(name) else None, markersize=2,
                    label=", ".join(words) or f"{len(x)} cells")


def draw_difference(ax, shots, name):
    """The second shot less the first, at the places of the first, linear between those of the
    second."""
    theirs = {material: (x, values) for material, x, values in shots[1].lines(name)}
    shown = []
    for n, (material, x, values) in enumerate(shots[0].lines(name)):
        if material not in theirs:
            continue
        other_x, other = theirs[material]
        change = np.interp(x, other_x, other, left=np.nan, right=np.nan) - values
        words = [f"{shots[1].label} - {shots[0].label}"]
        words += [materials.name(shots[0].archive, material)] if len(theirs) > 1 else []
        ax.plot(x, change, color=style.COLOURS[n % len(style.COLOURS)], linewidth=1.1,
                linestyle=style.LINES[n % len(style.LINES)], label=", ".join(words))
        shown.append(change)
    ax.axhline(0, color="#888888", linewidth=0.6)
    return np.concatenate(shown) if shown else np.zeros(1)


def x_label(shot):
    given = shot.given
    if given.line:
        return "distance from ({:g}, {:g}, {:g})  (m)".format(*given.line[0])
    return "distance from the origin  (m)" if given.radius else "xyz"[shot.directions[0]] + "  (m)"


def draw(ax, shots, name, exact, scale):
    """One panel of all shots."""
    given, shot = shots[0].given, shots[0]
    if given.radius:
        for each in shots:
            draw_radius(ax, each, name, len(shots) > 1)
    elif len(shots) > 1 or given.line:
        draw_several(ax, shots, name)
    elif shot.is_of_particles(name):
        draw_particles(ax, shot, name)
    else:
        draw_levels(ax, shot, name)
    if exact is not None and name in exact:
        ax.plot(exact["x"], exact[name], color="black", linewidth=0.9, label="exact", zorder=3)
    ax.set_xlabel(x_label(shot))
    ax.margins(x=0.01)
    set_scale(ax, scale, given, np.concatenate([each.numbers(name) for each in shots]), name)
    set_unit(ax, shot, name)


def set_unit(ax, shot, name):
    unit = quantities.unit_of(shot.step, name)
    if unit and unit != "1":
        ax.set_ylabel(style.unit_text(unit))


def set_scale(ax, scale, given, values, name):
    from .scales import asked_range
    asked = asked_range(given, name)
    if scale.log:
        ax.set_yscale("log")
    else:
        headroom(ax, values)
    if asked:
        ax.set_ylim(*asked)
    elif scale.fixed and scale.log:
        ax.set_ylim(scale.low / 1.2, scale.high * 1.2)
    elif scale.fixed:
        pad = 0.05 * (scale.high - scale.low)
        ax.set_ylim(scale.low - pad, scale.high + pad)
    elif not scale.log and len(values) and (np.nanmax(values) - np.nanmin(values)
                                            < 1e-3 * (scale.high - scale.low)):
        ax.set_ylim(scale.low, scale.high)  # equal to round-off of what they could be
