"""Draw how fast linear solvers get rid of the residual: residual against time, one line a solver.

    python3 -m sluice_tools residuals RESULTS -o PICTURE

RESULTS is the JSON of `sluice tune --json`: "curves", each with a name, of_deck (the solver that the
deck itself names), seconds (set-up, then set-up and solve to smaller and smaller tolerances) and
residuals (as shares of the right-hand side); "curve_goal", the tolerance that the deck asks for.
"""
import argparse
import json
import pathlib
import sys

from . import style


class ResultsError(Exception):
    """The results cannot be drawn; the message says what was expected."""


def read_results(path):
    try:
        told = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        curves = [{"name": str(c["name"]), "of_deck": bool(c["of_deck"]),
                   "seconds": [float(s) for s in c["seconds"]],
                   "residuals": [float(r) for r in c["residuals"]]} for c in told["curves"]]
        results = {"curves": curves, "goal": float(told["curve_goal"]),
                   "unknowns": int(told["unknowns"]), "title": told["title"] or told["deck"]}
    except (OSError, KeyError, TypeError, ValueError) as problem:
        raise ResultsError(f"{path}: cannot be read as the results of sluice tune ({problem!r}); "
                           "needed are curves, curve_goal, unknowns") from None
    if not curves:
        raise ResultsError(f"{path}: no solver met its goal; there is nothing to draw")
    return results


def scale_of(results):
    """Factor and unit in which the longest time has one to three digits before the point."""
    longest = max(max(c["seconds"]) for c in results["curves"])
    return next(((f, u) for f, u in ((1, "s"), (1e3, "ms")) if longest * f >= 1), (1e6, "µs"))


def draw(results, plt):
    fig, ax = plt.subplots(figsize=(6.4, 4.6))
    factor, unit = scale_of(results)
    for number, curve in enumerate(results["curves"]):
        own = curve["of_deck"]
        ax.plot([factor * s for s in curve["seconds"]], curve["residuals"],
                label=curve["name"] + (" (the deck's own)" if own else ""),
                color="black" if own else style.COLOURS[number % 6],
                linestyle=style.LINES[number % len(style.LINES)],
                marker="*" if own else style.MARKERS[number % len(style.MARKERS)],
                markersize=9 if own else 4.5, markeredgecolor="black", markeredgewidth=0.5,
                zorder=4 if own else 3)
    ax.set_yscale("log")
    ax.set_xlim(left=0)
    if results["goal"] > 0:
        ax.axhline(results["goal"], color="#888888", linewidth=0.9, linestyle=(0, (1, 2)))
        ax.annotate("goal of the deck", (0.995, results["goal"]),
                    xycoords=("axes fraction", "data"), textcoords="offset points", xytext=(0, 3),
                    ha="right", fontsize=7, color="#444444")
    ax.set_xlabel(f"set-up and solve  ({unit})")
    ax.set_ylabel("residual, as a share of the right-hand side")
    ax.set_title(f"{results['title']}: {results['unknowns']:,} unknowns", loc="left")
    ax.legend(loc="upper center", bbox_to_anchor=(0.45, -0.13), ncols=2)
    return fig


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="residuals", description="Draw residual against time")
    parser.add_argument("results")
    parser.add_argument("-o", "--output", default="residuals.png")
    given = parser.parse_args(arguments)
    return style.save_picture("residuals", lambda plt: draw(read_results(given.results), plt),
                              given.output, ResultsError)


if __name__ == "__main__":
    sys.exit(main())
