"""Checking and running single decks of the suites, and judging what comes out."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from suite_limits import (FEW_STEPS, LARGEST_DRIFT, LARGEST_GROWTH, LIMIT, MOST_CELLS_OF_SOLIDS,
                          MOST_COARSE_STEPS, MOST_STEPS, QUICK_STEPS, SOLIDS_LIMIT,
                          STEPS_OF_DETONATIONS)
from suite_reading import coarsened, load

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from sluice_tools.archive import Archive  # noqa: E402

NEVER_NEGATIVE = {"rho_CC", "temp_CC", "sp_vol_CC", "vol_frac_CC", "rho_micro_CC"}
MAY_NOT_GROW = {"rho_CC", "temp_CC", "press_CC"}


def faults_of(sluice, suite, names):
    """What `sluice check` says of each deck."""
    words = [sluice, "check", "--json", *names]
    told = subprocess.run(words, cwd=suite, capture_output=True, text=True)
    return [deck["faults"] for deck in json.loads(told.stdout)["decks"]]


def first_of(faults):
    """What to tell of the first error, or None; what is not supported comes last."""
    errors = [f for f in faults if f["kind"] in ("error", "not_built")]
    errors.sort(key=lambda f: f["kind"] != "error")
    if not errors:
        return None
    kind = "missing" if errors[0]["kind"] == "not_built" else "fault of the deck"
    missing = " is known to the format, but not supported yet"
    return f"{kind}: " + errors[0]["message"].replace(missing, "")


def run(sluice, suite, name, folder, options, limit=LIMIT):
    """(report or None, what went wrong)"""
    report = folder / "report.json"
    words = [sluice, "run", name, "-o", str(folder), "--progress", "none", "--quiet", "--json",
             str(report), *options]
    try:
        done = subprocess.run(words, cwd=suite, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, f"not finished in {limit} s"
    if done.returncode == 2:
        last = (done.stderr.strip() or done.stdout.strip() or "no message").splitlines()[-1]
        last = re.sub(r"^\S+\.ups(:\d+)*: (error: )?", "", last)
        return None, "missing: " + re.sub(r" (?:are|is) not supported yet.*", "", last)
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip() or "no message").splitlines()[-1]
        return None, f"fails: {last}"
    told = json.loads(report.read_text())
    if told["status"] not in ("done", "max_steps"):
        return None, f"ends with {told['status']}: {told['message']}"
    return told, ""


def drift_of(report):
    """The largest share of a total that was lost; momentum by the scale of its whole vector, or,
    where all is at rest, by that of sound."""
    totals = report["conservation"]
    mass = sum(t["scale"] for name, t in totals.items() if name.startswith("mass"))
    energy = totals["total energy"]["scale"]
    momentum = max([t["scale"] for name, t in totals.items() if name.startswith("momentum")] +
                   [math.sqrt(mass * energy)])
    worst = 0.0
    for name, t in totals.items():
        scale = momentum if name.startswith("momentum") else t["scale"]
        if not all(math.isfinite(t[part]) for part in ("now", "defect", "scale")):
            return math.nan
        worst = max(worst, abs(t["defect"]) / scale if scale > 0 else abs(t["defect"]))
    return worst


def values(step, label):
    for name, material, level in step.stored():
        if name == label:
            yield from (values for _, _, values in step.pieces(name, material, level))


def largest(step, label):
    return max(float(abs(v).max()) for v in values(step, label))


def bad_values(folder, detonates=False):
    """What is wrong with the last output of the archive, or nothing."""
    import numpy as np

    archive = Archive(next(folder.glob("*.000")))
    first, last = archive.step("first"), archive.step("last")
    for label in last.names():
        parts = list(values(last, label))
        if not all(np.isfinite(part).all() for part in parts):
            return f"{label} is not finite"
        if label in NEVER_NEGATIVE and min(part.min() for part in parts) < 0:
            return f"{label} is negative"
        if label == "vol_frac_CC" and max(part.max() for part in parts) > 1:
            return f"{label} is above 1"
        may_grow = detonates or label not in MAY_NOT_GROW
        if not may_grow and largest(last, label) > LARGEST_GROWTH * largest(first, label):
            return f"{label} grows {largest(last, label) / largest(first, label):.3g} times"
    return None


def run_whole(sluice, suite, path):
    """(good, what to tell) of the first steps of the deck as it stands"""
    with tempfile.TemporaryDirectory() as folder:
        report, wrong = run(sluice, suite, path.relative_to(suite).as_posix(),
                            pathlib.Path(folder), ["--max-steps", str(MOST_COARSE_STEPS)])
    if report is None:
        return False, wrong
    whole = report["status"] == "done"
    return True, f"runs{' to its end' if whole else ''}, {report['steps']} coarse steps"


def run_coarsened(sluice, suite, path, most_steps=MOST_STEPS):
    """(good, what to tell) of the deck made small"""
    options, cells = coarsened(path)
    detonates = re.search(r'type\s*=\s*"(JWLpp|LightTime)"', path.read_text(errors="replace"))
    if detonates:
        most_steps = min(most_steps, STEPS_OF_DETONATIONS)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        report, wrong = run(sluice, suite, path.relative_to(suite).as_posix(), folder,
                            ["--max-steps", str(most_steps), "--set",
                             "DataArchiver/outputLastTimestep=true", *options])
        if report is None:
            return False, wrong
        wrong = bad_values(folder, detonates is not None)
    drift = drift_of(report)
    if wrong or not drift <= LARGEST_DRIFT:
        return False, wrong or f"not conserved: {drift:.1e}"
    whole = report["status"] == "done" or report["steps"] < most_steps
    text = f"runs{' to its end' if whole else ''}, {report['steps']} steps"
    if cells is not None:
        text += f" on {' x '.join(map(str, cells))} cells"
    return True, text


def bad_particles(folder):
    """What is wrong with the last output of an archive of solids, or nothing."""
    import numpy as np

    last = Archive(next(folder.glob("*.000"))).step("last")
    for label in last.names():
        parts = list(values(last, label))
        if not all(np.isfinite(part).all() for part in parts):
            return f"{label} is not finite"
        if label in ("p.mass", "p.volume") and min(part.min() for part in parts) <= 0:
            return f"{label} is not positive"
    return None


def run_few(sluice, suite, path):
    """(good, what to tell) of the first steps of a deck of solids"""
    options, cells = coarsened(path, MOST_CELLS_OF_SOLIDS)
    saves = load(path).find("DataArchiver/save") is not None
    if saves:
        options += ["--set", "DataArchiver/outputLastTimestep=true"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        report, wrong = run(sluice, suite, path.relative_to(suite).as_posix(), folder,
                            ["--max-steps", str(FEW_STEPS), *options], SOLIDS_LIMIT)
        if report is None:
            return False, wrong
        wrong = bad_particles(folder) if saves else None
    for name, total in report["conservation"].items():
        if not all(math.isfinite(total[part]) for part in ("now", "defect", "scale")):
            wrong = wrong or f"{name} is not finite"
        elif name.startswith("mass") and abs(total["defect"]) > LARGEST_DRIFT * total["scale"]:
            wrong = wrong or f"{name} is not conserved"
    if wrong:
        return False, wrong
    count = sum(kind["here"] for kind in report["particles"])
    text = f"runs, {report['steps']} steps of {count:,} particles"
    return True, text + ("" if cells is None else f" on {' x '.join(map(str, cells))} cells")


def run_some(sluice, suite, path):
    """(good, what to tell) of the first steps of a deck of any kind, with what its end says"""
    options, cells = coarsened(path, MOST_CELLS_OF_SOLIDS)
    with tempfile.TemporaryDirectory() as name:
        report, wrong = run(sluice, suite, path.relative_to(suite).as_posix(), pathlib.Path(name),
                            ["--max-steps", str(QUICK_STEPS), *options], SOLIDS_LIMIT)
    if report is None:
        return False, f"accepted; {wrong}"
    whole = report["status"] == "done" or report["steps"] < QUICK_STEPS
    text = f"runs{' to its end' if whole else ''}, {report['steps']} steps"
    return True, text + ("" if cells is None else f" on {' x '.join(map(str, cells))} cells")


def state_of(sluice, suite, path, run_deck):
    fault = first_of(faults_of(sluice, suite, [path.relative_to(suite).as_posix()])[0])
    if fault:
        good, text = False, fault
    else:
        good, text = run_deck(sluice, suite, path)
    return good, re.sub(r"(<[^<>]+>)", r"`\1`", text).replace("|", "\\|")
