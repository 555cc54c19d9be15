"""The lists of decks: which decks, what a page tells of each, how they run."""
import pathlib
import re

from promised import promised_decks
from suite_pages import (AMR_HEAD, ICE_HEAD, IMPM_HEAD, MPM_HEAD, MPMICE_HEAD, SUITE_HEAD,
                         VAANGO_HEAD)
from suite_reading import component_of, levels_of, materials_of, models_of, short_name
from suite_runs import run_coarsened, run_few, run_some, run_whole

ROOT = pathlib.Path(__file__).resolve().parents[2]


def rows_of(page):
    """The rows of a page by the names of their decks: whether it runs, the line."""
    lines = re.findall(r"^(\| (\S+\.ups) \|.*\|)$", page.read_text(), re.M)
    return {name: (bool(re.search(r"\| runs[^|]*\|$", line)), line + "\n") for line, name in lines}


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


def promised(suite, deck_list):
    """The decks of the list that must run."""
    if getattr(deck_list, "variable", "SLUICE_DECKS") != "SLUICE_DECKS":
        return set()
    below = tuple(f"{folder}/".removeprefix("inputs/") for folder in deck_list.folders)
    return {name for name in promised_decks()
            if name.startswith(below) and deck_list.cells(suite / "inputs" / name) is not None}
