#!/usr/bin/env python3
"""Hold error bars and target errors of decks against the true errors of their studies.

Of each study of a field: the deck's own ladder gives an error bar at the deck's resolution, and the
study its true error there. The same for --target-error: the run that is chosen for that true error
is measured like any other. Writes docs/accuracy/bars.csv.
"""
import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys

from accuracy_page import read_study, studies_of

COLUMNS = ("study", "quantity", "error", "bar", "ratio", "target", "promised", "reached")
COVERED, SHARP = 0.8, 5  # the share that bars must cover; a bar of so many errors is still sharp


class Failed(Exception):
    """A command ended with a fault; its last line."""


def sluice(given, *words):
    """The output of a command that must be good."""
    ended = subprocess.run([given.sluice, *map(str, words)], stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True, check=False)
    if ended.returncode != 0:
        lines = [line for line in ended.stdout.splitlines() if line.strip()]
        raise Failed(lines[-1] if lines else f"status {ended.returncode}")
    return ended.stdout


def settings(study):
    """What every run of the default setting changes in the deck."""
    changes = list(study.get("set", []))
    for ladder in study.get("ladders", []):
        value = ladder["values"][ladder["default"]]
        changes += [value] if isinstance(value, str) else value
    return changes


def true_error(given, study, cells, folder):
    """The L1 error of the default setting with these cells, absolute and relative."""
    one = dict(study, resolution=[cells], deck=str(study["deck_path"]))
    one["ladders"] = [dict(ladder, values={ladder["default"]: ladder["values"][ladder["default"]]})
                      for ladder in study.get("ladders", [])]
    del one["deck_path"]
    file = folder / "one.study"
    file.write_text(json.dumps(one))
    sluice(given, "accuracy", file, "-o", folder / "true", "--repeat", 1)
    with (folder / "true/one.csv").open(newline="") as rows:
        row = next(csv.DictReader(line for line in rows if not line.startswith("#")))
    if row["status"] != "done":
        raise Failed(f"the run with {cells} cells is {row['status']}")
    return float(row["l1"]), float(row["relative_l1"])


def bar_of(given, study, folder):
    """The absolute bar of the study's variable at the deck's own resolution, and those cells."""
    words = [word for change in settings(study) for word in ("--set", change)]
    sluice(given, "accuracy", study["deck_path"], "-o", folder / "bar", "--json",
           folder / "bar.json", *words)
    found = json.loads((folder / "bar.json").read_text())
    own = next(n for n, run in enumerate(found["runs"]) if run["factor"] == 1)
    name = label_of(study)
    for quantity in found["quantities"]:
        if quantity["name"] == name and quantity["material"] == study.get("material", 0):
            bar = quantity["relative_error_bars"][own]
            return bar * quantity["mean_size"], found["runs"][own]["cells"]
    raise Failed(f"the deck saves no {name}")


def label_of(study):
    """The label without the component: p.stress of p.stress.zz."""
    parts = study.get("variable", "rho_CC").split(".")
    kept = 2 if parts[0] == "p" else 1
    return ".".join(parts[:kept])


def cells_chosen(text, own):
    """The cells of the run that --target-error said it takes."""
    found = re.search(r"resolution=\[(\d+), *(\d+), *(\d+)\]", text)
    return [int(n) for n in found.groups()] if found else own


def target_of(given, study, folder, relative, cells):
    """Promised and true relative error of the run that is chosen for this error."""
    words = [word for change in settings(study) for word in ("--set", change)]
    text = sluice(given, "run", study["deck_path"], "-o", folder / "chosen.uda", "--target-error",
                  f"{relative:.6g}", "--quantity", label_of(study), *words)
    return true_error(given, study, cells_chosen(text, cells), folder)[1]


def measured(given, name):
    """One row of the table; None where the study has no field to compare."""
    path = given.root / "regression/accuracy" / f"{name}.study"
    study = read_study(path)
    if "reduce" in study or study.get("variable") == "lost energy":
        return None
    study["deck_path"] = (path.parent / study["deck"]).resolve()
    folder = given.folder / name
    folder.mkdir(parents=True, exist_ok=True)
    bar, cells = bar_of(given, study, folder)
    error, relative = true_error(given, study, cells, folder)
    row = {"study": name, "quantity": study.get("variable", "rho_CC"), "error": error, "bar": bar,
           "ratio": bar / error if error > 0 else float("inf")}
    try:
        row |= {"target": relative, "reached": target_of(given, study, folder, relative, cells)}
    except Failed as refused:
        row["promised"] = str(refused)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("--only", nargs="+")
    given = parser.parse_args()
    rows, failed = [], []
    for name in given.only or studies_of(given.root):
        try:
            row = measured(given, name)
        except Failed as why:
            failed.append(name)
            print(f"{name}: {why}", flush=True)
            continue
        if row:
            rows.append(row)
            print("  ".join(f"{key} {value:.3g}" if isinstance(value, float) else str(value)
                            for key, value in row.items()), flush=True)
    if not given.only:
        with (given.root / "docs/accuracy/bars.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    covered = sum(row["ratio"] >= 1 for row in rows)
    sharp = sum(row["ratio"] <= SHARP for row in rows)
    promised = [row for row in rows if "reached" in row]
    kept = sum(row["reached"] <= row["target"] for row in promised)
    print(f"RESULT: {covered} of {len(rows)} bars cover the true error, {sharp} are at most "
          f"{SHARP} times it; {kept} of {len(promised)} targets are kept"
          + (f"; failed: {', '.join(failed)}" if failed else ""))
    good = (not failed and covered >= COVERED * len(rows) and sharp >= len(rows) / 2
            and kept >= COVERED * len(promised))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
