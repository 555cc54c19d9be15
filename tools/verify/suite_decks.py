#!/usr/bin/env python3
"""Write docs/LIST_decks.md: the state of every deck of a list of the format's public suite.

    SLUICE_DECKS=FOLDER tools/verify/suite_decks.py --sluice build/release/bin/sluice LIST...

LIST is amr (decks with <AMR> or several <Level>s, run for some coarse steps), ice (decks of
inputs/ICE, coarsened to seconds), mpm (decks of solids, a few steps), impm (implicit steps,
likewise), mpmice (fluid and solids, a few steps), suite (all of them) or vaango (Vaango's suite, in
the folder that SLUICE_VAANGO_DECKS names). A deck that `sluice
check` finds good is run; of any other the first fault is told. --check writes nothing and fails
when a page is not what it would write. --test is quick: `sluice check` must find every deck good
that the page says runs, and one deck of each kind is run for a few steps; exit 77 means that
SLUICE_DECKS is not set. Whatever a page says, the decks of regression/promised_decks.txt run.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
from promised import promised_decks  # noqa: E402
from sluice_tools.archive import Archive  # noqa: E402

LIMIT = 300  # seconds a deck
NO_SUITE = 77
MOST_CELLS = 20000  # of a coarsened deck
MOST_STEPS = 200
STEPS_OF_DETONATIONS = 20  # whose products fill their levels
QUICK_STEPS = 20  # of the decks that --test runs
MOST_COARSE_STEPS = 30  # of a deck with levels
FEW_STEPS = 10  # of solids
SOLIDS_LIMIT = 150  # seconds a deck of solids
MOST_CELLS_OF_SOLIDS = 200_000
LARGEST_DRIFT = 1e-14  # of a total
LARGEST_GROWTH = 10.0  # of density, temperature and pressure

AMR_HEAD = f"""# Decks with levels

Every deck of the format's public suite that has `<AMR>` or several `<Level>`s, and its state. This
page is written by `tools/verify/suite_decks.py amr`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify decks` checks that it holds. The decks are taken as they stand, for at
most {MOST_COARSE_STEPS} coarse steps. Of those that do not run the first thing that is missing is
told, as `sluice check` or the start of the run says it.

"""

ICE_HEAD = f"""# Decks of the fluid

Every deck of the folder `inputs/ICE` of the format's public suite, and its state. This page is
written by `tools/verify/suite_decks.py ice`, which finds the suite through the variable
`SLUICE_DECKS`; `./dev verify decks` checks every row, the test `tools.ice_decks` runs some steps of
a deck of each kind. Decks run coarsened to seconds: at most {MOST_STEPS} steps, and a grid of one
box of more than {MOST_CELLS:,} cells by a smaller `resolution`; the last step is saved. A deck runs
when it ends in good order; all totals and all values of its last output are finite, densities,
temperatures and volumes not negative, volume fractions at most 1; density, temperature and pressure
are at most {LARGEST_GROWTH:g} times their largest in the first output; mass of each material,
momentum and total energy are conserved to {LARGEST_DRIFT:g}, what passed the boundary counted. That
says nothing of accuracy: see [theory_ice.md](theory_ice.md). Of the others the first thing that is
missing is told, as `sluice check` or the start of the run says it.

"""


MPM_HEAD = f"""# Decks of solids

Every deck of the folders `inputs/MPM` and `inputs/UintahRelease/MPM` of the format's public suite,
and its state. This page is written by `tools/verify/suite_decks.py mpm`, which finds the suite
through the variable `SLUICE_DECKS`; `./dev verify decks` checks every row. Decks run for
{FEW_STEPS} steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller
`resolution`; the last step is saved. A deck runs when it ends in good order, all totals and all
values of its last output are finite, volumes and masses of particles are positive, and the mass of
each material is conserved to {LARGEST_DRIFT:g}. That says nothing of accuracy. Of the others the
first thing that is missing is told, as `sluice check` or the start of the run says it.

"""

IMPM_HEAD = f"""# Decks of implicit steps

Every deck of the folders `inputs/IMPM` and `inputs/UintahRelease/IMPM` of the format's public
suite, and its state. This page is written by `tools/verify/suite_decks.py impm`, which finds the
suite through the variable `SLUICE_DECKS`; `./dev verify decks` checks every row. Decks run for
{FEW_STEPS} steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller
`resolution`; the last step is saved. A deck runs when it ends in good order, all totals and all
values of its last output are finite, volumes and masses of particles are positive, and the mass of
each material is conserved to {LARGEST_DRIFT:g}. That says nothing of accuracy. Of the others the
first thing that is missing is told, as `sluice check` or the start of the run says it.

"""


MPMICE_HEAD = f"""# Decks of fluid and solids

Every deck of the format's public suite whose component is `mpmice` or one of its kin, and its
state. This page is written by `tools/verify/suite_decks.py mpmice`, which finds the suite through
the variable `SLUICE_DECKS`; `./dev verify decks` checks every row. Decks run for {FEW_STEPS} steps,
a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller `resolution`; the last
step is saved. A deck runs when it ends in good order, all totals and all values of its last output
are finite, volumes and masses of particles are positive, and the mass of each material is conserved
to {LARGEST_DRIFT:g}, what passed from one to another aside. That says nothing of accuracy. Of the
others the first thing that is missing is told, as `sluice check` or the start of the run says it.

"""


SUITE_HEAD = f"""# The public suite

Every deck of the format's public suite, and its state: accepted by `sluice check` or not, and how
far it runs. This page is written by `tools/verify/suite_decks.py suite`, which finds the suite
through the variable `SLUICE_DECKS`; `./dev verify decks` checks every row. Decks that stand on
the page of a kind (fluids, solids, both, implicit steps, levels) have the state told there; the
others run for {QUICK_STEPS} steps. Of those that are not accepted the first fault is told.

"""

VAANGO_HEAD = f"""# Decks of Vaango's suite

Every deck of Vaango's suite (June 2025) that is not among those of the format's public suite, and
its state: accepted by `sluice check` or not, and how far it runs. This page is written by
`tools/verify/suite_decks.py vaango`, which finds the suite through the variable
`SLUICE_VAANGO_DECKS`; `./dev verify decks` checks every row. Accepted decks run for {QUICK_STEPS}
steps, a grid of one box of more than {MOST_CELLS_OF_SOLIDS:,} cells by a smaller `resolution`. That
says nothing of accuracy. Of those that are not accepted the first fault is told; files that the
suite itself lacks are such faults.

"""


class NoDeck(Exception):
    """The file cannot be read as a deck; what it says can still be searched."""


def load(path):
    """The deck's root with its includes resolved; files lie beside the deck or in the suite."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        raise NoDeck(str(error)) from error
    resolve(root, path.parent)
    return root


def resolve(element, folder):
    for place, child in enumerate(list(element)):
        if child.tag != "include":
            resolve(child, folder)
            continue
        name = child.get("href", "")
        found = next((p for p in (folder / name, pathlib.Path(name)) if p.is_file()), None)
        if found is None:
            raise NoDeck(f"{name} does not exist")
        part = load(found)
        for step in (child.get("section") or "").strip("/").split("/"):
            below = part.find(step) if step and step != part.tag else part
            part = part if below is None else below
        element.remove(child)
        element.insert(place, part)


def levels_of(path):
    """What the deck says of levels, or None when it has none."""
    try:
        root = load(path)
    except NoDeck:
        text = re.sub(r"<!--.*?-->", "", path.read_text(errors="replace"), flags=re.DOTALL)
        return "not readable" if "<AMR" in text or text.count("<Level>") > 1 else None
    statics = len(root.findall("Grid/Level"))
    amr = root.find("AMR")
    if amr is None and statics < 2:
        return None
    if statics > 1:
        return f"{statics} fixed"
    most = (root.findtext("AMR/Regridder/max_levels") or "1").strip()
    return f"up to {most}" if int(most) > 1 else "one"


def component_of(path):
    try:
        found = load(path).find("SimulationComponent")
    except NoDeck:
        return ""
    return "" if found is None else found.get("type", "")


def materials_of(path):
    try:
        return str(len(load(path).findall("MaterialProperties/ICE/material")))
    except NoDeck:
        return ""


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


def models_of(path):
    """The constitutive models that the deck names."""
    try:
        found = load(path).iterfind("MaterialProperties/MPM/material/constitutive_model")
    except NoDeck:
        return ""
    return ", ".join(sorted({model.get("type", "") for model in found}))


def coarsened(path, most=MOST_CELLS):
    """Overrides that make the deck small, and the cells it then has (None: as it stands)."""
    levels = load(path).findall("Grid/Level")
    boxes = levels[0].findall("Box") if len(levels) == 1 else []
    if len(boxes) != 1 or boxes[0].find("resolution") is None:
        return [], None
    cells = [int(part) for part in boxes[0].findtext("resolution").strip(" []\n").split(",")]
    if math.prod(cells) <= most:
        return [], None
    long = [n for n in cells if n > 1]
    factor = (math.prod(cells) / most) ** (1 / len(long))
    cells = [max(1, int(n / factor)) if n > 1 else 1 for n in cells]
    text = ",".join(map(str, cells))
    return ["--set", f"Grid/Level/Box/resolution=[{text}]"], cells


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


NEVER_NEGATIVE = {"rho_CC", "temp_CC", "sp_vol_CC", "vol_frac_CC", "rho_micro_CC"}
MAY_NOT_GROW = {"rho_CC", "temp_CC", "press_CC"}


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


class AmrList:
    page = ROOT / "docs" / "amr_decks.md"
    head, folders = AMR_HEAD, ("inputs",)
    columns = "| deck | component | levels | state |\n| --- | --- | --- | --- |\n"
    told = "decks with levels run"
    run_deck = staticmethod(run_whole)

    @staticmethod
    def cells(path):
        levels = levels_of(path)
        return None if levels is None else [component_of(path), levels]


class IceList:
    page = ROOT / "docs" / "ice_decks.md"
    head, folders = ICE_HEAD, ("inputs/ICE",)
    columns = "| deck | materials | levels | state |\n| --- | --- | --- | --- |\n"
    told = "decks of the fluid run"
    run_deck = staticmethod(run_coarsened)
    # One of a kind, that --test runs: one gas, laws of it, levels that stay and that move, waves
    # that leave, slip, friction; several materials, what passes from one to another; the pressure
    # solve on one level and on several, of several materials of different laws, with a scalar.
    quick = ("advect", "riemann_jwl", "advectAMR", "riemann_AMR", "Lodi_counterflow", "microSlip",
             "riemann_sm_turb", "advect2mat", "hotBlob2mat", "massX", "CouettePoiseuille/XY",
             "mms_1", "1D_impAdvectScalarAMR", "impHotBlobAMR", "fallingDam_waterAir",
             "advectScalar")

    @staticmethod
    def cells(path):
        return [materials_of(path), levels_of(path) or ""]


class MpmList:
    page = ROOT / "docs" / "mpm_decks.md"
    head, folders = MPM_HEAD, ("inputs/MPM", "inputs/UintahRelease/MPM")
    columns = "| deck | component | constitutive models | state |\n| --- | --- | --- | --- |\n"
    told = "decks of solids run"
    run_deck = staticmethod(run_few)

    @staticmethod
    def cells(path):
        return [component_of(path), models_of(path)]


class ImpmList(MpmList):
    page = ROOT / "docs" / "impm_decks.md"
    head, folders = IMPM_HEAD, ("inputs/IMPM", "inputs/UintahRelease/IMPM")
    told = "decks of implicit steps run"


class MpmIceList:
    page = ROOT / "docs" / "mpmice_decks.md"
    head = MPMICE_HEAD
    folders = ("inputs/MPMICE", "inputs/Models", "inputs/MPM", "inputs/UintahRelease/MPMICE")
    columns = ("| deck | component | fluids | constitutive models | state |\n"
               "| --- | --- | --- | --- | --- |\n")
    told = "decks of fluid and solids run"
    run_deck = staticmethod(run_few)

    @staticmethod
    def cells(path):
        component = component_of(path)
        if "mpmice" not in component.lower():
            return None
        return [component, str(materials_of(path)), models_of(path)]


class SuiteList:
    page = ROOT / "docs" / "suite_decks.md"
    head, folders = SUITE_HEAD, ("inputs",)
    columns = "| deck | component | state |\n| --- | --- | --- |\n"
    told = "decks of the public suite run"
    counts = True
    variable = "SLUICE_DECKS"

    @staticmethod
    def cells(path):
        return [component_of(path)]

    @staticmethod
    def run_deck(sluice, suite, path):
        name = short_name(suite, path)
        for other in (MpmList, IceList, MpmIceList, ImpmList, AmrList):
            found = rows_of(other.page).get(name)
            if found is not None:
                good, line = found
                return good, re.split(r" (?<!\\)\| ", line.rstrip(" |\n"))[-1]
        return run_some(sluice, suite, path)


class VaangoList(SuiteList):
    page = ROOT / "docs" / "vaango_decks.md"
    head = VAANGO_HEAD
    told = "decks of Vaango's suite run"
    variable = "SLUICE_VAANGO_DECKS"
    run_deck = staticmethod(run_some)


LISTS = {"amr": AmrList, "ice": IceList, "mpm": MpmList, "impm": ImpmList,
         "mpmice": MpmIceList, "suite": SuiteList, "vaango": VaangoList}


def short_name(suite, path):
    return path.relative_to(suite).as_posix().removeprefix("inputs/")


def promised(suite, deck_list):
    """The decks of the list that must run."""
    if getattr(deck_list, "variable", "SLUICE_DECKS") != "SLUICE_DECKS":
        return set()
    below = tuple(f"{folder}/".removeprefix("inputs/") for folder in deck_list.folders)
    return {name for name in promised_decks()
            if name.startswith(below) and deck_list.cells(suite / "inputs" / name) is not None}


def rows_of(page):
    """The rows of a page by the names of their decks: whether it runs, the line."""
    lines = re.findall(r"^(\| (\S+\.ups) \|.*\|)$", page.read_text(), re.M)
    return {name: (bool(re.search(r"\| runs[^|]*\|$", line)), line + "\n") for line, name in lines}


def make_page(sluice, suite, deck_list, only=""):
    """The page's text, what to tell of it, the names of the decks that run. Decks whose names do
    not match `only` keep their rows."""
    kept = rows_of(deck_list.page) if only else {}

    def row(path):
        cells = deck_list.cells(path)
        if cells is None:
            return None
        if short_name(suite, path) in kept and not re.search(only, short_name(suite, path)):
            good, line = kept[short_name(suite, path)]
            return good, short_name(suite, path), line
        good, state = state_of(sluice, suite, path, deck_list.run_deck)
        name = short_name(suite, path)
        return good, name, f"| {' | '.join([name, *cells, state])} |\n"

    paths = sorted(p for f in deck_list.folders for p in (suite / f).rglob("*.ups"))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = [found for found in pool.map(row, paths) if found is not None]
    running = [line for good, _, line in rows if good]
    text = deck_list.head
    accepted = sum(not re.search(r"\| (missing|fault of the deck): [^|]*\|$", line)
                   for _, _, line in rows)
    counts = getattr(deck_list, "counts", False)
    count = f"{accepted} of {len(rows)} decks are accepted, {len(running)} run.\n\n"
    text += count if counts else f"{len(running)} of {len(rows)} decks run.\n\n"
    text += deck_list.columns
    text += "".join(running) + "".join(line for good, _, line in rows if not good)
    told = f"{len(running)} of {len(rows)} {deck_list.told}"
    told += f", {accepted} are accepted" if counts else ""
    return text, told, {name for good, name, _ in rows if good}


def broken_decks(sluice, suite):
    """Of the fluid's decks that the page says run, or that are promised: what `sluice check` finds
    bad, and decks of a kind whose first steps fail; how many were checked and run."""
    names = set(re.findall(r"^\| (\S+\.ups) \|.*\| runs[^|]*\|$", IceList.page.read_text(), re.M))
    names |= promised(suite, IceList)
    names = sorted(names)
    told = faults_of(sluice, suite, [f"inputs/{name}" for name in names])
    broken = [f"{name}: {first_of(faults)}" for name, faults in zip(names, told, strict=True)
              if first_of(faults)]
    for name in (f"ICE/{short}.ups" for short in IceList.quick):
        if name not in names:
            broken.append(f"{name}: the page does not say that it runs")
            continue
        good, state = run_coarsened(sluice, suite, suite / "inputs" / name, QUICK_STEPS)
        if not good:
            broken.append(f"{name}: {state}")
    return broken, len(names), len(IceList.quick)


def test(sluice, suite):
    """Whether the quick test passes; says what was found."""
    broken, checked, run_here = broken_decks(sluice, suite)
    for line in broken:
        print(f"   FAILED {line}")
    print(f"RESULT: {checked} decks of the fluid checked, {run_here} run for {QUICK_STEPS} steps, "
          f"{len(broken)} faults")
    return checked > 0 and not broken


def treat(sluice, suite, deck_list, given):
    """Whether all is well with a list; says what was found."""
    text, told, running = make_page(sluice, suite, deck_list, given.only)
    lost = promised(suite, deck_list) - running
    if lost:
        print(f"RESULT: promised, but do not run: {', '.join(sorted(lost))}")
        return False
    if not given.check:
        deck_list.page.write_text(text)
    elif not deck_list.page.exists() or deck_list.page.read_text() != text:
        print(f"RESULT: {deck_list.page.name} is out of date: write it anew without --check")
        return False
    print(f"RESULT: {told}")
    return True


def enter_suite(variable):
    """The folder of a suite, which becomes the working folder; None: the variable is not set."""
    suite = os.environ.get(variable)
    if not suite:
        print(f"suite_decks: {variable} does not name the folder of the suite", file=sys.stderr)
        return None
    suite = pathlib.Path(suite).resolve()
    os.chdir(suite)  # includes are also looked for here
    return suite


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--check", action="store_true", help="compare with the pages only")
    parser.add_argument("--only", default="", metavar="PATTERN",
                        help="decks whose names match; the others keep their rows")
    parser.add_argument("--test", action="store_true",
                        help="check the decks of the fluid that run, run some steps of a few")
    parser.add_argument("lists", nargs="*", metavar="LIST", help=", ".join(sorted(LISTS)))
    given = parser.parse_args()
    if bool(given.lists) == given.test or not set(given.lists) <= LISTS.keys():
        parser.error(f"give lists of {', '.join(sorted(LISTS))}, or --test")
    sluice = str(pathlib.Path(given.sluice).resolve())
    if given.test:
        suite = enter_suite("SLUICE_DECKS")
        return NO_SUITE if suite is None else 0 if test(sluice, suite) else 1
    good = []
    for name in given.lists:
        suite = enter_suite(getattr(LISTS[name], "variable", "SLUICE_DECKS"))
        if suite is None:
            return 2
        good.append(treat(sluice, suite, LISTS[name], given))
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
