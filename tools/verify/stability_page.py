#!/usr/bin/env python3
"""Write docs/stability.md from the map that `sluice stability` wrote, and copy its picture.

    stability_page.py --map stability.json --picture stability.png --docs DOCS

Its last line says how many defaults and runs hold, for `./dev verify`.
"""
import argparse
import json
import pathlib
import shutil
import sys

HEAD = """# Where hard cases hold

This page is written by `./dev verify stability`, which runs every case of `regression/stability`
with all values of its sweeps. `sluice stability NAME` repeats one;
[user_guide.md](user_guide.md#hard-cases) explains the command, which also sweeps a deck of your
own.

{headline}

Bold: the default. ~~Struck~~: red, something did not hold. (In brackets): amber, it held, but too
many steps were redone. A † marks values beyond the limit of the scheme itself, which need not hold.
The *margin* is the largest value up to which all from the default on are green, over the default.

![map of verdicts](stability/stability.png)
"""


def default_of(case):
    return next(run for run in case["runs"] if "sweep" not in run)


def value_text(case, sweep, value):
    run = next((r for r in case["runs"] if r.get("sweep") == sweep["name"]
                and r.get("value") == value), None)
    is_default = run is None
    run = run or default_of(case)
    text = f"**{value}**" if is_default else value
    text = {"red": f"~~{text}~~", "amber": f"({text})"}.get(run["verdict"], text)
    return text + ("" if run["counts"] else "†")


def sweep_text(case, sweep):
    values = " ".join(value_text(case, sweep, v) for v in sweep["values"])
    margin = sweep.get("margin")
    if margin is None:
        return f"{sweep['name']}: {values}"
    sign = "over " if sweep["never_failed_above"] else ""
    return f"{sweep['name']}: {values}, margin {sign}{margin:.3g}"


def case_row(case):
    run = default_of(case)
    return (f"| {case['name']} | {case['title']} | {run['verdict']} | {run['steps']} | "
            + "; ".join(sweep_text(case, s) for s in case["sweeps"]) + " |")


def failures(case):
    rows = []
    for run in case["runs"]:
        if run["verdict"] == "green" or not run["counts"]:
            continue
        name = f"{run['sweep']} {run['value']}" if "sweep" in run else "default"
        message = " ".join(run["message"].split()).replace("|", "\\|")
        rows.append(f"| {case['name']} | {name} | {run['verdict']} | {message} |")
    return rows


def headline(told):
    share = 100 * told["points_held"] / max(1, told["points"])
    return (f"{told['defaults_held']} of {len(told['cases'])} defaults hold, and "
            f"{told['points_held']} of {told['points']} runs within the limits of their schemes "
            f"({share:.1f} %).")


def page(told):
    text = HEAD.format(headline=headline(told))
    for component in ("fluid", "solids", "coupled", "reactions"):
        cases = [c for c in told["cases"] if c["component"] == component]
        if not cases:
            continue
        text += f"\n## {component.capitalize()}\n\n| case | what | default | steps | sweeps |\n"
        text += "| --- | --- | --- | --- | --- |\n"
        text += "\n".join(case_row(c) for c in cases) + "\n"
    rows = [row for case in told["cases"] for row in failures(case)]
    if rows:
        text += "\n## What does not hold\n\n| case | run | verdict | what failed first |\n"
        text += "| --- | --- | --- | --- |\n" + "\n".join(rows) + "\n"
    return text


def main():
    parser = argparse.ArgumentParser()
    for name in ("map", "picture", "docs"):
        parser.add_argument("--" + name, required=True, type=pathlib.Path)
    given = parser.parse_args()
    told = json.loads(given.map.read_text(encoding="utf-8"))
    (given.docs / "stability.md").write_text(page(told), encoding="utf-8")
    (given.docs / "stability").mkdir(exist_ok=True)
    shutil.copy(given.picture, given.docs / "stability" / "stability.png")
    print("RESULT: " + headline(told))
    return 0


if __name__ == "__main__":
    sys.exit(main())
