"""What is drawn of a label: one number a cell, of one material where it is, or of the whole.

Of several materials in a cell, with their masses per volume of the cell r (rho_CC):
    density of the whole       sum r
    velocity, temperature      sum r q / sum r, means over mass
Labels that belong to the cell (the common pressure) are taken as they are. A material that is not
in a cell has no value there: NaN, which pictures leave white.
"""
import dataclasses

import numpy as np

from .archive import ArchiveError
from .scalars import scalar, split_name

COMMON = {"press_CC", "press_equil_CC", "sum_rho_CC", "solid.fraction"}  # of the cell
MEANS = {"vel_CC", "temp_CC"}  # over the mass of all materials
SCHLIEREN = "schlieren"  # |grad rho|, as if it were a label
PRESENT = ("vol_frac_CC", "rho_CC", "temp_CC")  # positive where a material is


def is_of_whole(step, base):
    """Whether this label, asked for without a material, is that of all materials together."""
    if base in COMMON:
        return True
    if not step.has(base):
        return False
    there = step.materials(base)
    if len(there) < 2:
        return False
    if base == "rho_CC":
        return True
    return base in MEANS and step.has("rho_CC") and set(there) <= set(step.materials("rho_CC"))


def material_of(step, base, material):
    """The material whose values are drawn; None: of the whole."""
    if material is not None and base not in COMMON:
        return material
    return None if is_of_whole(step, base) else step.materials(base)[0]


def presence(step, material, level, lower, shape):
    """True where a material is in cells of this box; None where nothing saved tells it."""
    for name in PRESENT:
        if (name, material, level) not in step.stored():
            continue
        field = step.field(name, material, level)
        if field.lower == lower and field.values.shape[-3:] == shape:
            return field.values > 0
    return None


def _any_presence(step, level, field):
    """Where any material with fields in cells is."""
    found = None
    fluids = {m for name in PRESENT if step.has(name) for m in step.materials(name)}
    for material in sorted(fluids):
        there = presence(step, material, level, field.lower, field.values.shape[-3:])
        if there is None:
            return None
        found = there if found is None else found | there
    return found


def _whole(step, base, level):
    """Of all materials together, in the shape of the first one's field."""
    if base in COMMON:
        return step.field(base, None, level)
    total, weighted = 0.0, 0.0
    fields = [step.field(base, m, level) for m in step.materials(base)]
    for field in fields:
        mass = np.nan_to_num(step.field("rho_CC", field.material, level).values)
        total = total + mass
        weighted = weighted + np.where(mass > 0, mass * field.values, 0)
    if base == "rho_CC":
        return dataclasses.replace(fields[0], values=np.where(total > 0, total, np.nan))
    with np.errstate(invalid="ignore", divide="ignore"):
        return dataclasses.replace(fields[0], values=np.where(total > 0, weighted / total, np.nan))


def density_label(step):
    """The label from which schlieren pictures are made."""
    for name in ("rho_CC", "sum_rho_CC", "rho_micro_CC"):
        if step.has(name):
            return name
    raise ArchiveError("schlieren needs a saved density: rho_CC, sum_rho_CC or rho_micro_CC")


def label_of(step, name):
    """The saved label behind a name: 'rho_CC' of 'schlieren', 'vel_CC' of 'vel_CC.x'."""
    return density_label(step) if name == SCHLIEREN else split_name(name)[0]


def unit_of(step, name):
    unit = step.archive.variables[label_of(step, name)].unit
    if name != SCHLIEREN:
        return unit
    return "kg/m^4" if unit == "kg/m^3" else f"{unit}/m"


def gradient_size(values, spacing, active):
    """|grad q| [i, j, k] by differences of neighbours: central, one-sided beside what is absent."""
    square = np.zeros(values.shape)
    for d in active:
        if values.shape[d] < 2:
            continue
        change = np.diff(values, axis=d) / spacing[d]
        edge = np.full_like(np.take(values, [0], axis=d), np.nan)
        both = np.stack([np.concatenate([edge, change], axis=d),
                         np.concatenate([change, edge], axis=d)])
        known = np.isfinite(both)
        slope = np.where(known, both, 0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
        square += slope ** 2
    return np.where(np.isfinite(values), np.sqrt(square), np.nan)


def level_field(step, name, material=None, level=0, along=None):
    """A Field of one number a place. material None: of the whole where the label has a whole, else
    of the first material that has it. along: of vectors the component along this direction."""
    if name == SCHLIEREN:
        field = level_field(step, density_label(step), material, level)
        spacing, active = field.level.spacing, step.levels[0].active_directions()
        return dataclasses.replace(field, values=gradient_size(field.values, spacing, active))
    base, component = split_name(name)
    require(step, name, material)
    own = material_of(step, base, material)
    field = _whole(step, base, level) if own is None else step.field(base, own, level)
    values = scalar(base, field.values, component, along)
    if field.variable.centring == "cell":
        there = (_any_presence(step, level, field) if own is None else
                 presence(step, own, level, field.lower, values.shape))
        if there is not None:
            values = np.where(there, values, np.nan)
    return dataclasses.replace(field, values=values)


def fluids(step):
    """Materials with fields in cells that tell where they are."""
    return sorted({m for name in PRESENT if step.has(name) for m in step.materials(name)})


def share(step, material, level=0):
    """The part that a material has of the fluid in cells, by volume (else by mass): a Field; None
    where nothing saved tells it."""
    for name in ("vol_frac_CC", "rho_CC"):
        if (name, material, level) not in step.stored():
            continue
        field = step.field(name, material, level)
        total = sum(np.nan_to_num(step.field(name, m, level).values) for m in step.materials(name))
        with np.errstate(invalid="ignore", divide="ignore"):
            return dataclasses.replace(field, values=np.where(total > 0, field.values / total, 0))
    return None


def require(step, name, material):
    """ArchiveError with what there is, before anything is drawn."""
    base = label_of(step, name)
    if not step.has(base):
        step.field(base, material)
    if material is not None and base not in COMMON and material not in step.materials(base):
        raise ArchiveError(f"'{base}' is not stored for material {material}; materials: "
                           f"{step.materials(base)}")
