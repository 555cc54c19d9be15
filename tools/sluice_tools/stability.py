"""Draw where hard cases hold: a map of verdicts, and a page with what must hold and what failed.

    python3 -m sluice_tools stability MAP.json -o PICTURE [--page PAGE.html]

MAP.json is what `sluice stability` writes: "cases", each with "name", "title", "sweeps" (name,
default, values) and "runs" (verdict, sweep, value, message, command, ...). Verdicts can be told
apart without colours: red fields have a cross, amber ones a dash, the default a thick frame, values
beyond the scheme's own limit a pale colour.
"""
import argparse
import base64
import html
import json
import pathlib
import sys

from . import style

COLOURS = {"green": "#8fd19e", "amber": "#ffd17a", "red": "#e57373"}
PALE = {"green": "#e3f4e7", "amber": "#fff2d9", "red": "#f9dedc"}
MARKS = {"green": "", "amber": "–", "red": "×"}
ROW = 0.21  # inches of a row
VALUE_WIDTH = 1.0  # of a field, in units of the axis
GAP = 0.5
LETTER = 0.115  # the width of a letter above a sweep, in the same units
LEAST_WIDTH = 7  # inches


class MapError(Exception):
    """The map cannot be drawn; the message says what was expected."""


def read_map(path):
    try:
        told = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        for case in told["cases"]:
            default_of(case)
        return told
    except (OSError, ValueError, KeyError, TypeError, StopIteration) as problem:
        raise MapError(f"{path}: cannot be read as a map of stability ({problem})") from None


def default_of(case):
    return next(run for run in case["runs"] if "sweep" not in run)


def run_of(case, sweep, value):
    """The run of a value of a sweep; the default run for the default value."""
    for run in case["runs"]:
        if run.get("sweep") == sweep["name"] and run.get("value") == value:
            return run
    return default_of(case) if value == sweep["default"] else None


def fields_of(case):
    """(x, label, run, is_default) of each value of each sweep, and the x and text of each sweep."""
    fields, heads, x = [], [], 0.0
    for sweep in case["sweeps"]:
        heads.append((x, sweep["name"] + margin_text(sweep)))
        end = x + LETTER * len(heads[-1][1])
        for value in sweep["values"]:
            run = run_of(case, sweep, value)
            if run is not None:
                fields.append((x, value, run, value == sweep["default"]))
                x += VALUE_WIDTH
        x = max(x, end) + GAP
    if not case["sweeps"]:
        heads.append((x, ""))
        fields.append((x, "default", default_of(case), True))
    return fields, heads


def margin_text(sweep):
    margin = sweep.get("margin")
    if margin is None or margin == 0:
        return ""
    return f" ({'>' if sweep.get('never_failed_above') else ''}{margin:.3g}×)"


def draw(told, plt):
    cases = sorted(told["cases"], key=lambda c: (c["component"], c["name"]))
    widest = max(max((f[0] for f in fields_of(c)[0]), default=0) for c in cases) + VALUE_WIDTH
    size = (max(LEAST_WIDTH, 2.6 + 0.42 * widest), 0.9 + 2 * ROW * len(cases))
    fig, ax = plt.subplots(figsize=size)
    for row, case in enumerate(cases):
        fields, heads = fields_of(case)
        for x, text in heads:
            ax.text(x, 2 * row + 0.42, text, fontsize=6, va="center", color="#444444")
        for x, label, run, is_default in fields:
            draw_field(ax, x, 2 * row + 0.8, label, run, is_default)
    ax.set_yticks([2 * row + 1.25 for row in range(len(cases))],
                  [f"{c['name']}  ·  {c['component']}" for c in cases], fontsize=7)
    ax.set_xticks([])
    ax.set_xlim(-0.2, widest + 0.2)
    ax.set_ylim(2 * len(cases) + 0.2, 0)
    ax.grid(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_visible(False)
    ax.tick_params(length=0)
    fig.suptitle(headline(told), x=0.01, ha="left", fontsize=10)
    return fig


def draw_field(ax, x, y, label, run, is_default):
    from matplotlib.patches import Rectangle
    palette = COLOURS if run.get("counts", True) else PALE
    ax.add_patch(Rectangle((x + 0.03, y), VALUE_WIDTH - 0.06, 0.9,
                           facecolor=palette[run["verdict"]],
                           edgecolor="black" if is_default else "#999999",
                           linewidth=1.4 if is_default else 0.4))
    text = f"{label} {MARKS[run['verdict']]}".strip()
    ax.text(x + VALUE_WIDTH / 2, y + 0.47, text, ha="center", va="center",
            fontsize=6 if len(text) < 8 else 4.6)


def headline(told):
    if len(told["cases"]) == 1:
        return told["cases"][0]["title"]
    return (f"{told['defaults_held']} of {len(told['cases'])} defaults hold, "
            f"{told['points_held']} of {told['points']} runs within the limits of their schemes")


PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Stability</title><style>
body {{ font: 15px/1.45 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; }}
img {{ max-width: 100%; }}
table {{ border-collapse: collapse; margin: .4em 0 1em; }}
td, th {{ border: 1px solid #bbb; padding: .15em .5em; text-align: left; vertical-align: top; }}
.green {{ background: {green}; }} .amber {{ background: {amber}; }} .red {{ background: {red}; }}
.pale {{ opacity: .55; }} code {{ font-size: 85%; word-break: break-all; }}
</style></head><body>
<h1>Where hard cases hold</h1>
<p>{headline}. {program}, {date}.</p>
<p>Green: what must hold held, and few steps were redone. Amber: it held, but too many steps were
redone. Red: something did not hold, or the run ended early. Pale: beyond the limit of the scheme
itself.</p>
<p><img src="data:image/png;base64,{picture}" alt="map of verdicts"></p>
{cases}
</body></html>
"""


def case_html(case):
    must = "".join(f"<li>{html.escape(text)}</li>" for text in case["must_hold"])
    rows = "".join(run_html(run) for run in case["runs"])
    source = f" Source: {html.escape(case['source'])}" if case["source"] else ""
    return (f"<h2 id=\"{html.escape(case['name'])}\">{html.escape(case['title'])}</h2>"
            f"<p><b>{html.escape(case['name'])}</b>, {html.escape(case['component'])}. "
            f"{html.escape(case['why'])}{source}</p>"
            f"<p>It must hold:</p><ul>{must}</ul><table><tr><th>run</th><th>verdict</th>"
            f"<th>steps</th><th>redone</th><th>found</th></tr>{rows}</table>")


def run_html(run):
    name = f"{run['sweep']} {run['value']}" if "sweep" in run else "default"
    pale = "" if run["counts"] else " pale"
    found = "; ".join(f"{c['found']:.3g}" for c in run["checks"])
    if run["message"]:
        found = html.escape(run["message"]) + f"<br><code>{html.escape(run['command'])}</code>"
    return (f"<tr><td>{html.escape(name)}</td><td class=\"{run['verdict']}{pale}\">"
            f"{run['verdict']}</td><td>{run['steps']}</td><td>{run['redone']}</td>"
            f"<td>{found}</td></tr>")


def page_html(told, picture):
    cases = sorted(told["cases"], key=lambda c: (c["component"], c["name"]))
    return PAGE.format(headline=html.escape(headline(told)), program=html.escape(told["program"]),
                       date=html.escape(told["date"]), picture=picture,
                       cases="\n".join(case_html(c) for c in cases), **COLOURS)


def write_page(told, picture, path):
    """The page, with the picture that was saved as a PNG."""
    image = base64.b64encode(pathlib.Path(picture).read_bytes()).decode("ascii")
    pathlib.Path(path).write_text(page_html(told, image), encoding="utf-8")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="stability", description="Draw where hard cases hold")
    parser.add_argument("map")
    parser.add_argument("-o", "--output", default="stability.png")
    parser.add_argument("--page")
    given = parser.parse_args(arguments)
    status = style.save_picture("stability", lambda plt: draw(read_map(given.map), plt),
                                given.output, MapError)
    if status == 0 and given.page:
        try:
            write_page(read_map(given.map), given.output, given.page)
        except OSError as error:
            print(f"stability: {error}", file=sys.stderr)
            return 3
    return status


if __name__ == "__main__":
    sys.exit(main())
