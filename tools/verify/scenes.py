#!/usr/bin/env python3
"""Run random scenes; each must finish and keep what is conserved.

Kinds: fluid (scene_fluid.py), solid (scene_solid.py), coupled (scene_coupled.py). Mass and
momentum are kept to the kind's DRIFT of their scale (masses of coupled scenes: of their sum), the
fluid's energy too; that of solids closes with its account (transfer, integration, contact,
surfaces).
Every number follows from the seed alone: a scene that fails is kept and can be run again. Every
fourth coupled scene runs on two or three ranks too, and must keep the same totals to the bit.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import scene_coupled
import scene_fluid
import scene_solid

KINDS = {"fluid": scene_fluid, "solid": scene_solid, "coupled": scene_coupled}
STEPS = 200


def unexplained(report, kind):
    """Drift of each conserved quantity, without the part of the energy that the account names."""
    kept = report["conservation"]
    drifts = {name: abs(row["drift"]) for name, row in kept.items()}
    if kind is scene_coupled:  # round-off where dense and thin gases meet is that of their sum
        masses = {name: row for name, row in kept.items() if name.startswith("mass ")}
        total = sum(row["scale"] for row in masses.values())
        drifts |= {name: abs(row["defect"]) / total for name, row in masses.items()}
    account = {name: x for name, x in report["energy_account"].items() if name != "nodes"}
    if account:
        energy = kept["total energy"]
        # Where each loss is large a sum's last bits are theirs, not the energy's.
        scale = max([energy["scale"], *map(abs, account.values())]) or 1
        lost = sum(value for name, value in account.items() if name != "within particles")
        drifts["total energy"] = abs(energy["defect"] + lost) / scale
    return drifts


def run(given, deck, report, ranks=1):
    words = [given.sluice, "run", str(deck), "--no-output", "--max-steps", str(STEPS), "--progress",
             "none", "--json", str(report)]
    if ranks > 1:
        words = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + words
    return subprocess.run(words, capture_output=True, text=True, timeout=300)


def difference_on_ranks(given, deck, report, ranks):
    """What several ranks do otherwise than one, whose report this is; None: nothing."""
    other = report.with_name("report_of_ranks.json")
    done = run(given, deck, other, ranks)
    if done.returncode != 0:
        return f"exit {done.returncode} on {ranks} ranks: {done.stderr.strip()[-200:]}"
    one, several = json.loads(report.read_text()), json.loads(other.read_text())
    for name in ("steps", "time", "conservation", "energy_account"):
        if one[name] != several[name]:
            return f"{name} differs on {ranks} ranks"
    return None


def fault(given, kind, deck, report, ranks):
    """What is wrong with a run; None: nothing."""
    try:
        done = run(given, deck, report)
    except subprocess.TimeoutExpired:
        return "not finished in 300 s"
    if done.returncode != 0:
        errors = [line for line in done.stderr.splitlines() if "error" in line]
        return f"exit {done.returncode}: {errors[0] if errors else 'no message'}"
    drifts = unexplained(json.loads(report.read_text()), kind)
    worst = max(drifts, key=drifts.get)
    if drifts[worst] > kind.DRIFT:
        return f"{worst} drifts by {drifts[worst]:.2g} of its scale"
    return difference_on_ranks(given, deck, report, ranks) if ranks > 1 else None


def run_kind(given, name, count):
    """How many of the scenes of a kind failed."""
    kind, failed = KINDS[name], 0
    for seed in range(given.first, given.first + count):
        text, words = kind.scene(seed)
        deck = given.folder / f"{name}_{seed}.ups"
        deck.write_text(text)
        ranks = 2 + seed // 4 % 2 if name == "coupled" and seed % 4 == 0 else 1
        wrong = fault(given, kind, deck, given.folder / "report.json", ranks)
        if wrong is None:
            deck.unlink()
            continue
        failed += 1
        print(f"   FAILED {name} scene {seed} ({words}): {wrong}\n          {deck}", flush=True)
    print(f"   {count - failed} of {count} {name} scenes", flush=True)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--first", type=int, default=0, help="seed of the first scene")
    for name in KINDS:
        parser.add_argument("--" + name, type=int, default=0, help=f"random {name} scenes")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)

    counts = {name: getattr(given, name) for name in KINDS}
    failed = sum(run_kind(given, name, count) for name, count in counts.items())
    told = ", ".join(f"{count} {name}" for name, count in counts.items())
    print(f"RESULT: {failed} of {sum(counts.values())} random scenes failed ({told})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
