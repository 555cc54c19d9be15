"""The scale of what is drawn: lowest and highest value, colours, straight or logarithmic; one for
all panels that show the same label."""
import dataclasses

import numpy as np

from . import materials, quantities, scalars
from .archive import ArchiveError

SHARPNESS = 6.0  # of schlieren: shade 1 - exp(-SHARPNESS g/g_max)
SHARE_OF_SOUND = 1e-3  # velocities below ROUND_OFF of this share of the speed of sound are noise
SHARE_OF_MODULUS = 1e-4  # stresses likewise, of the largest modulus of the deck
MODULI = ("bulk_modulus", "shear_modulus", "youngs_modulus", "K", "G", "E", "B0", "G0", "K0")


@dataclasses.dataclass
class Scale:
    low: float
    high: float
    colours: str = "cividis"
    log: bool = False
    schlieren: bool = False
    fixed: bool = False  # that of all frames of a movie

    def norm(self):
        from matplotlib import colors
        if self.schlieren:
            top = self.high or 1.0
            return colors.FuncNorm(
                (lambda g: 1 - np.exp(-SHARPNESS * g / top),
                 lambda y: -top / SHARPNESS * np.log(np.maximum(1 - y, 1e-300))), 0, top)
        return (colors.LogNorm if self.log else colors.Normalize)(self.low, self.high)

    def shown(self, values):
        """Values as they are drawn: on a logarithmic scale none below its end."""
        return np.maximum(values, self.low) if self.log else values


def _moduli(archive):
    found = [0.0]
    for _, material in materials.elements(archive):
        for e in material.iterfind("constitutive_model/*"):
            try:
                found.append(float(e.text) if e.tag in MODULI else 0.0)
            except (TypeError, ValueError):
                continue
    return max(found)


def natural_size(step, name):
    """How large values of this label could be: of a component the size of the whole vector; of
    velocities and stresses a share of the speed of sound and of the moduli."""
    if name == quantities.SCHLIEREN:
        return 0.0
    base, component = scalars.split_name(name)
    sizes = [0.0]
    variable = step.archive.variables.get(base)
    fields = variable is not None and variable.centring in ("cell", "node")
    if component is not None and fields:
        sizes += [np.nanmax(np.abs(step.field(base, m).values)) for m in step.materials(base)]
    if base == "vel_CC" and step.has("press_CC") and step.has("rho_CC"):
        density = quantities.level_field(step, "rho_CC").values
        pressure = np.abs(step.field("press_CC").values)
        if np.isfinite(density).any():
            sizes.append(SHARE_OF_SOUND * np.sqrt(np.nanmax(pressure) / np.nanmax(density)))
    if "stress" in base.lower():
        sizes.append(SHARE_OF_MODULUS * _moduli(step.archive))
    if base == "p.velocity":
        densities = [float(e.findtext("density", "0") or 0)
                     for _, e in materials.elements(step.archive)]
        if max(densities, default=0) > 0:
            sizes.append(SHARE_OF_SOUND * np.sqrt(_moduli(step.archive) / max(densities)))
    return float(max(sizes))


def asked_range(given, name):
    """(low, high) of --range for this label, or None."""
    base = name if name == quantities.SCHLIEREN else scalars.split_name(name)[0]
    for wanted in (name, base, None):
        for label, low, high in given.range:
            if label == wanted:
                return low, high
    return None


def of_numbers(numbers, size, name, given):
    """The Scale of these values of a label, as it is asked for."""
    asked = asked_range(given, name)
    numbers = numbers[np.isfinite(numbers)]
    if not len(numbers):
        numbers = np.array(asked or [0.0])
    if given.log:
        above = numbers[numbers > 0]
        if not len(above) and not asked:
            raise ArchiveError(f"--log: no value of {name} is above zero")
        low, high = asked or (above.min(), above.max())
        if not low > 0:
            raise ArchiveError(f"--range {low:g}:{high:g}: a logarithmic scale begins above zero")
        if not high > low * (1 + scalars.ROUND_OFF):
            low, high = 0.9 * low, 1.1 * high
        return Scale(low, high, given.cmap or "cividis", log=True)
    low, high, colours = scalars.colour_range(numbers, size)
    if asked:
        low, high = asked
        colours = "PuOr" if low < 0 < high else "cividis"
    if name == quantities.SCHLIEREN:
        return Scale(0.0, asked[1] if asked else float(numbers.max()), "gray_r", schlieren=True)
    return Scale(low, high, given.cmap or colours)


def of_shots(shots, name, given):
    numbers = np.concatenate([shot.numbers(name) for shot in shots])
    return of_numbers(numbers, max(natural_size(shot.step, name) for shot in shots), name, given)
