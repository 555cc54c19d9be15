"""Pictures of what goes by time or place beside the fields: histories, samples of <DataAnalysis>,
cells of levels, the cost of effects; of several archives over each other."""
import dataclasses
import json

import numpy as np

from . import levels, lines, samples, style
from .archive import ArchiveError
from .plot_layout import Panels, panel_grid

PLACES = ("X", "Y", "Z")
GUIDES = (*PLACES, "x", "y", "z", "Time", "time", "Timestep", "Level", "nCells", "weight")


@dataclasses.dataclass
class Curve:
    label: str
    x: np.ndarray
    y: np.ndarray


@dataclasses.dataclass
class Graph:
    """One panel: curves, or bars with names, or cells of a plane."""
    title: str
    x_label: str
    unit: str = ""
    curves: list = dataclasses.field(default_factory=list)
    steps: bool = False  # values hold until the next one
    bars: dict = None
    cells: tuple = None  # (names of the axes, x, y, values[j, i])


def _base(column):
    """Columns of one vector belong together."""
    return column[:-2] if column[-2:] in (".x", ".y", ".z") else column


def _groups(kind, columns):
    """[(title, its columns)]: one panel each."""
    values = [c for c in columns if c not in GUIDES]
    if kind == "history":
        return [("", [c for c in columns if c not in ("Time", "Timestep")])]
    if kind == "extremes":
        return [("", values)]
    if kind == "particle":
        values = [c for c in columns if c not in ("Time", "time")]
        places = [c for c in values if c in ("x", "y", "z")]
        values = [c for c in values if c not in places]
        groups = [("place", places)] if places else []
    else:
        groups = []
    if kind == "budget" and "X_faces" in columns:
        return [("mass", ["Total"]), ("fluxes", [c for c in values if c != "Total"])]
    for column in values:
        base = _base(column)
        own = [c for c in values if _base(c) == base]
        if (base, own) not in groups:
            groups.append((base, own))
    return groups


def _along(table):
    """(column that lines go by, its axis label)."""
    for name in ("Time", "time"):
        if name in table.columns:
            return table.column(name), "time  (s)"
    if "Timestep" in table.columns:
        return table.column("Timestep"), "step"
    return np.arange(1, len(table.rows) + 1), "line"


def _title(name, group):
    return f"{name}: {group}" if group else name


def _short(column, group):
    return column[len(group) + 1:] if group and column.startswith(group + ".") else column


def _of_time(archive, sample, name):
    table = samples.read(sample)
    x, x_label = _along(table)
    graphs = []
    for group, columns in _groups(sample.kind, table.columns):
        graph = Graph(_title(name, group), x_label, samples.unit(sample, columns[0], archive))
        if group == "place":
            graph.unit = "m"
        for column in columns:
            label = "" if len(columns) == 1 else _short(column, group)
            graph.curves.append(Curve(label, x, table.column(column)))
        graphs.append(graph)
    return graphs


def _places(table):
    """(which of x, y, z vary, the distance of each row from the first)."""
    at = np.stack([table.column(c) for c in PLACES], axis=1)
    vary = [d for d in range(3) if np.ptp(at[:, d]) > 0]
    return vary, at, np.linalg.norm(at - at[0], axis=1)


def _times_of_line(table, wanted):
    found = np.unique(table.column("Time"))
    if not wanted:
        return [found[-1]]
    return [found[0] if t == "first" else found[-1] if t == "last" else
            found[np.abs(found - float(t)).argmin()] for t in wanted]


def _asked_times(given):
    """Numbers, first or last; outputs by number mean nothing to samples."""
    for text in given.time or ():
        if text in ("first", "last"):
            continue
        try:
            float(text)
        except ValueError as error:
            raise ArchiveError(f"--time {text}: of samples write a time, first or last") from error
    return given.time or []


def _of_places(archive, sample, name, given):
    """Lines, planes and averages: values over places, at one time or several."""
    asked = _asked_times(given)
    tables = []
    if sample.kind == "line":
        table = samples.read(sample)
        for time in _times_of_line(table, asked):
            rows = table.rows[table.column("Time") == time]
            tables.append(samples.Table(table.columns, rows, float(time)))
    else:
        when = samples.times(sample)
        tables = [samples.read(sample, when.min() if t == "first" else when.max() if t == "last"
                               else float(t)) for t in asked or ["last"]]
    vary, _, _ = _places(tables[0])
    if len(vary) == 2 and sample.kind == "plane":
        return _of_plane(archive, sample, name, tables[-1], vary)
    graphs = []
    for group, columns in _groups(sample.kind, tables[0].columns):
        along = "xyz"[vary[0]] + "  (m)" if len(vary) == 1 else "distance along the line  (m)"
        graph = Graph(_title(name, group), along, samples.unit(sample, columns[0], archive))
        for table in tables:
            _, at, distance = _places(table)
            x = at[:, vary[0]] if len(vary) == 1 else distance
            for column in columns:
                words = [] if len(columns) == 1 else [_short(column, group)]
                graph.curves.append(Curve(", ".join([*words, f"t = {table.time:.6g} s"]), x,
                                          table.column(column)))
        graphs.append(graph)
    return graphs


def _of_plane(archive, sample, name, table, vary):
    graphs = []
    axes = [np.unique(table.column(PLACES[d])) for d in vary]
    at = [np.searchsorted(axes[n], table.column(PLACES[d])) for n, d in enumerate(vary)]
    for column in table.columns:
        if column in GUIDES:
            continue
        values = np.full((len(axes[1]), len(axes[0])), np.nan)
        values[at[1], at[0]] = table.column(column)
        graph = Graph(f"{_title(name, column)}  t = {table.time:.6g} s",
                      "xyz"[vary[0]] + "  (m)", samples.unit(sample, column, archive))
        graph.cells = ("xyz"[vary[1]] + "  (m)", axes[0], axes[1], values)
        graphs.append(graph)
    return graphs


def _of_levels(archive):
    table = archive.level_cells()
    graph = Graph("cells of each level", "time  (s)", steps=True)
    graph.curves = [Curve(f"level {level}", table[:, 1], cells)
                    for level, cells in enumerate(table[:, 2:].T)]
    return [graph]


def effects_of(archive):
    """{effect: seconds} of run.json, those that cost something, most first."""
    path = archive.path / "run.json"
    try:
        told = json.loads(path.read_text(encoding="utf-8"))["effects"]
        costs = {e["name"]: float(e["seconds"]) for e in told if e.get("on")}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ArchiveError(f"{path}: tells no effects ({error!r}); it is written at the end of a "
                           "run") from error
    return dict(sorted(costs.items(), key=lambda item: -item[1]))


def graphs_of(archive, name, given):
    if name == "levels":
        return _of_levels(archive)
    if name == "effects":
        return [Graph("time of each effect", "time  (s)", bars=effects_of(archive))]
    sample = samples.find(archive, name)
    if sample.kind in ("line", "plane", "average"):
        return _of_places(archive, sample, name, given)
    return _of_time(archive, sample, name)


def _draw_bars(ax, drawn):
    """Bars of each archive beside each other, in the order of the first."""
    names = list(dict.fromkeys(name for _, graph in drawn for name in graph.bars))[:20]
    height = 0.8 / len(drawn)
    for n, (label, graph) in enumerate(drawn):
        at = np.arange(len(names)) + (n - 0.5 * (len(drawn) - 1)) * height
        ax.barh(at, [graph.bars.get(name, 0) for name in names], height=0.9 * height,
                color=style.COLOURS[n % len(style.COLOURS)], label=label)
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.locator_params(axis="x", nbins=5)
    ax.ticklabel_format(axis="x", style="sci", scilimits=(-3, 4))
    ax.set_xlabel(drawn[0][1].x_label)


def _draw_cells(fig, ax, graph, log):
    from .scalars import colour_range
    y_label, x, y, values = graph.cells
    low, high, colours = colour_range(values[np.isfinite(values)])
    image = ax.pcolormesh(x, y, np.ma.masked_invalid(values), shading="nearest", cmap=colours,
                          **({"norm": "log"} if log else {"vmin": low, "vmax": high}),
                          rasterized=True)
    ax.set_xlabel(graph.x_label)
    ax.set_ylabel(y_label)
    ax.set_aspect("equal")
    ax.grid(False)
    style.colour_bar(fig, ax, image, graph.unit)


def _draw_curves(ax, drawn, given):
    several = len(drawn) > 1
    every = []
    for n, (label, graph) in enumerate(drawn):
        for c, curve in enumerate(graph.curves):
            words = [word for word in (label if several else "", curve.label) if word]
            look = {"color": lines.colour_of(n if several else c,
                                             len(drawn) if several else len(graph.curves)),
                    "linestyle": style.LINES[(c if several else 0 if len(graph.curves) > 6 else c)
                                             % len(style.LINES)]}
            if len(curve.x) == 1:
                look["marker"] = "o"
            plot = ax.step if graph.steps else ax.plot
            plot(curve.x, curve.y, label=", ".join(words) or None,
                 **({"where": "post"} if graph.steps else {}), **look)
            every.append(np.ravel(curve.y))
    graph = drawn[0][1]
    ax.set_xlabel(graph.x_label)
    if graph.unit and graph.unit != "1":
        ax.set_ylabel(style.unit_text(graph.unit))
    if given.log:
        ax.set_yscale("log")
    elif every:
        lines.headroom(ax, np.concatenate(every))
    if ax.get_legend_handles_labels()[0]:
        ax.legend()


def draw(given, plt):
    """The figure of all that --history names, of all archives."""
    from .shots import open_archives
    archives = open_archives(given)
    panels = {}  # title -> [(name of the archive, graph)]
    for archive, label in archives:
        for name in given.history:
            for graph in graphs_of(archive, name, given):
                panels.setdefault(graph.title, []).append((label, graph))
    rows, columns = panel_grid(len(panels))
    figure = Panels(plt, rows, columns, 6.0 if columns == 1 else 4.2, 2.6, given)
    for ax, (title, drawn) in zip(figure.axes.flat, panels.items()):
        if drawn[0][1].bars is not None:
            _draw_bars(ax, drawn)
            if len(drawn) > 1:
                ax.legend()
        elif drawn[0][1].cells is not None:
            if len(drawn) > 1:
                raise ArchiveError(f"{title}: a plane is drawn of one archive at a time")
            _draw_cells(figure.fig, ax, drawn[0][1], given.log)
        else:
            _draw_curves(ax, drawn, given)
        ax.set_title(title, loc="left")
    head = given.title or " and ".join(dict.fromkeys(a.title() for a, _ in archives))
    return figure.finish(head, len(panels))
