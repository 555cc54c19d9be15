"""Draw what accuracy costs: error against wall time, one line a setting, at most six.

    python3 -m sluice_tools workprecision RESULTS -o PICTURE [--title TEXT]

RESULTS is the CSV (or JSON: a list of such rows, or an object with "rows") of `sluice accuracy`:

    setting    what all runs of a line share ("order 2, CFL 0.4")
    cells      resolution of the run, written beside its point
    seconds    wall time of the run
    error      error in the study's norm; empty or not a number when the run failed
    status     "done", else the run failed
    default    1 (or true) for the setting that a deck gets when it says nothing
    nx ny nz   cells along each direction (JSON: resolution), for the lines of order 1 and 2

Drawn are the default, the setting with the least error, and those of the runs that no other run
beats; a note counts the others. A line of a comment "# the error of the reference is below E"
(JSON: reference.error) is drawn as a level. Drawn so that a black and white print can be read:
each line has its own dashes and marker.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import sys

from . import style

FAILED_AT = 0.985  # height of the marks of failed runs, as a share of the frame
FAILED = "#cc0000"
GUIDES = "#888888"
LEGEND_WIDTH = 105  # characters beside one another below the frame
NEAREST_NOTE = 0.035  # no resolution is written twice within this share of the frame
MOST_LINES = 6


class StudyError(Exception):
    """The results cannot be drawn; the message says what was expected."""


def _row(raw, path):
    try:
        error = float(raw.get("error") or "nan")
        done = str(raw.get("status", "done")) == "done" and math.isfinite(error)
        size = raw.get("resolution") or [int(raw[n]) for n in ("nx", "ny", "nz") if raw.get(n)]
        return {"setting": str(raw["setting"]), "cells": str(raw["cells"]),
                "seconds": float(raw.get("seconds") or "nan"), "error": error, "done": done,
                "directions": sum(n > 1 for n in size),
                "default": str(raw.get("default", "")).lower() in ("1", "true", "yes")}
    except (KeyError, TypeError, ValueError) as problem:
        raise StudyError(f"{path}: a row lacks {problem}; needed are setting, cells, seconds, "
                         "error") from problem


def read_results(path):
    """The rows, and the error of the reference or None."""
    path = pathlib.Path(path)
    reference = None
    try:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".json":
            told = json.loads(text)
            raw = told["rows"] if isinstance(told, dict) else told
            if isinstance(told, dict) and isinstance(told.get("reference"), dict):
                reference = told["reference"].get("error")
        else:
            found = re.search(r"^# the error of the reference is below ([^,\s]+)", text, re.M)
            reference = float(found.group(1)) if found else None
            raw = list(csv.DictReader(line for line in text.splitlines()
                                      if not line.startswith("#")))
    except (OSError, ValueError, KeyError) as problem:
        raise StudyError(f"{path}: cannot be read as the results of a study ({problem})") from None
    rows = [_row(r, path) for r in raw]
    if not rows:
        raise StudyError(f"{path}: the study holds no run")
    return rows, reference


def read_rows(path):
    return read_results(path)[0]


def pareto_front(rows):
    """The runs that no other run beats in both time and error, fastest first."""
    front = []
    for row in sorted((r for r in rows if r["done"]), key=lambda r: (r["seconds"], r["error"])):
        if not front or row["error"] < front[-1]["error"]:
            front.append(row)
    return front


def by_setting(rows):
    lines = {}
    for row in rows:
        lines.setdefault(row["setting"], []).append(row)
    return lines


def diverges(runs):
    """The error of the finest run is above that of the next coarser one by more than a tenth."""
    done = sorted((r for r in runs if r["done"]), key=lambda r: int(r["cells"]))
    return len(done) > 1 and done[-1]["error"] > 1.1 * done[-2]["error"]


def drawn_settings(rows):
    """The default, the one with the least error, those on the front; in the order of the rows."""
    lines = by_setting(rows)
    done = [r for r in rows if r["done"]]
    chosen = [s for s, runs in lines.items() if any(r["default"] for r in runs)]
    if done:
        chosen.append(min(done, key=lambda r: r["error"])["setting"])
    front = [r["setting"] for r in pareto_front(rows)]
    chosen += sorted(set(front), key=lambda s: -front.count(s))
    if len(lines) <= MOST_LINES:
        chosen += list(lines)
    chosen = list(dict.fromkeys(chosen))[:MOST_LINES]
    return [s for s in lines if s in chosen]


def draw(rows, plt, title="", error_label="error", reference=None):
    fig, ax = plt.subplots(figsize=(6.4, 4.6))
    lines = by_setting(rows)
    drawn = drawn_settings(rows)
    shown = [r for r in rows if r["setting"] in drawn]
    front = pareto_front(rows)
    if len(front) > 1:
        ax.plot([r["seconds"] for r in front], [r["error"] for r in front], color="#c8c8c8",
                linewidth=7, solid_capstyle="round", zorder=1, label="best for its time")
    for number, setting in enumerate(drawn):
        draw_setting(ax, number, setting, lines[setting])
    ax.set_xscale("log")
    ax.set_yscale("log")
    widen(ax, shown)
    draw_guides(ax, shown)
    note_cells(ax, shown)
    mark_failures(ax, rows)
    if reference and ax.get_ylim()[0] < reference < ax.get_ylim()[1]:
        ax.axhline(reference, color=GUIDES, linewidth=0.9, linestyle=(0, (6, 3)), zorder=0,
                   label="error of the reference")
    ax.set_xlabel("wall time  (s)")
    ax.set_ylabel(error_label)
    ax.set_title(title, loc="left")
    if len(drawn) < len(lines):
        left = len(lines) - len(drawn)
        ax.text(0.01, 0.012, f"{left} other setting{'s' if left > 1 else ''}: see the table of all "
                "runs", transform=ax.transAxes, fontsize=6.5, color="#555555")
    handles, texts = ax.get_legend_handles_labels()
    ax.legend(handles, texts, loc="upper center", bbox_to_anchor=(0.45, -0.13),
              ncols=legend_columns(texts))
    return fig


def draw_guides(ax, rows):
    """Slopes of order 1 and 2 through the finest run of the default, where time grows as the cells
    times the steps, N^(d + 1)."""
    directions = max((r["directions"] for r in rows), default=0)
    done = [r for r in rows if r["done"] and r["seconds"] > 0 and r["error"] > 0]
    of_default = [r for r in done if r["default"]] or done
    if not directions or len(done) < 2:
        return
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    start = max(of_default, key=lambda r: int(r["cells"]))
    for order in (1, 2):
        slope = -order / (directions + 1)
        at = lambda x, slope=slope: start["error"] * (x / start["seconds"]) ** slope
        first = max(left, start["seconds"] * (top / start["error"]) ** (1 / slope))
        last = min(right, start["seconds"] * (bottom / start["error"]) ** (1 / slope))
        ax.plot([first, last], [at(first), at(last)], color=GUIDES, linewidth=0.8, linestyle=":",
                zorder=0)
        below = top * (bottom / top) ** 0.06  # so that the words stand inside the frame
        inside = max(first * (right / left) ** 0.01,
                     start["seconds"] * (below / start["error"]) ** (1 / slope))
        ax.annotate(f"order {order}", (inside, at(inside)), fontsize=6.5, color=GUIDES,
                    textcoords="offset points", xytext=(4, 2))
    ax.set_xlim(left, right)
    ax.set_ylim(bottom, top)


def legend_columns(texts):
    """As many of at most three as fit below the frame, each as wide as its widest text and mark."""
    columns = min(3, len(texts))
    while columns > 1 and columns * (max(len(t) for t in texts) + 8) > LEGEND_WIDTH:
        columns -= 1
    return columns


def note_cells(ax, rows):
    """The resolution beside each point, once where points of one resolution coincide."""
    to_frame = ax.transData + ax.transAxes.inverted()
    noted = []
    for r in (r for r in rows if r["done"]):
        x, y = to_frame.transform((r["seconds"], r["error"]))
        if all(c != r["cells"] or math.hypot(x - u, y - v) > NEAREST_NOTE for u, v, c in noted):
            noted.append((x, y, r["cells"]))
            ax.annotate(r["cells"], (r["seconds"], r["error"]), textcoords="offset points",
                        xytext=(5, 3), fontsize=6.5, color="#333333")


def look(number):
    return {"color": style.COLOURS[number % len(style.COLOURS)],
            "linestyle": style.LINES[number % len(style.LINES)],
            "marker": style.MARKERS[number % len(style.MARKERS)]}


def draw_setting(ax, number, setting, runs):
    done = sorted((r for r in runs if r["done"]), key=lambda r: int(r["cells"]))
    look_of_line = look(number)
    size = 4.5
    text = setting
    if any(r["default"] for r in runs):
        look_of_line["marker"], size = "*", 11
        text += " (default)"
    if diverges(runs):
        text += ": divergence"
    ax.plot([r["seconds"] for r in done], [r["error"] for r in done], label=text, zorder=3,
            markersize=size, markeredgecolor="black", markeredgewidth=0.5, linewidth=1.1,
            **look_of_line)


def widen(ax, rows):
    """Room for the annotations on the right and for the marks of failed runs above."""
    seconds = [r["seconds"] for r in rows if r["seconds"] > 0]
    errors = [r["error"] for r in rows if r["done"] and r["error"] > 0]
    if seconds:
        ax.set_xlim(min(seconds) / 1.5, max(seconds) * 1.9)
    if errors:
        ax.set_ylim(min(errors) / 1.6, max(errors) * 2.2)


def mark_failures(ax, rows):
    """A failed run is a red cross on the upper frame, at the time it took to fail."""
    left, right = ax.get_xlim()
    first = True
    for r in (r for r in rows if not r["done"]):
        seconds = r["seconds"] if r["seconds"] > 0 else left * 1.05
        ax.plot([min(max(seconds, left), right)], [FAILED_AT], marker="x", markersize=7,
                markeredgewidth=1.8, color=FAILED, transform=ax.get_xaxis_transform(),
                clip_on=False, linestyle="none", zorder=5, label="failed" if first else None)
        ax.annotate(r["cells"], (min(max(seconds, left), right), FAILED_AT),
                    xycoords=ax.get_xaxis_transform(), textcoords="offset points",
                    xytext=(6, -8), fontsize=6.5, color=FAILED)
        first = False


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="workprecision", description="Draw error against time")
    parser.add_argument("results")
    parser.add_argument("-o", "--output", default="workprecision.png")
    parser.add_argument("--title", default="")
    parser.add_argument("--error-label", default="error")
    given = parser.parse_args(arguments)

    def picture(plt):
        rows, reference = read_results(given.results)
        return draw(rows, plt, given.title, given.error_label, reference)

    return style.save_picture("workprecision", picture, given.output, StudyError)


if __name__ == "__main__":
    sys.exit(main())
