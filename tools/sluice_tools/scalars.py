"""From what is stored to one number a place: components, sizes, invariants, ranges of colours."""
import numpy as np

from .archive import TENSOR, ArchiveError

# Labels with a dot in them begin with one of these.
KINDS = ("p", "g", "cz", "solid", "work", "state", "SteadyBurn",
         "UnsteadyBurn")
SIGNED = 0.02  # values are drawn around zero when the smaller side is at least this share
ROUND_OFF = 1e-9  # differences below this share are drawn as none
INVARIANTS = ("vonMises", "pressure", "det", "size")


def split_name(name):
    """'vel_CC.x' -> ('vel_CC', 'x'); 'p.stress.xy' -> ('p.stress', 'xy'); 'p.x' -> ('p.x', None)"""
    parts = name.split(".")
    length = 2 if parts[0] in KINDS and len(parts) > 1 else 1
    base, component = ".".join(parts[:length]), ".".join(parts[length:])
    if not component:
        return base, None
    if component not in ("x", "y", "z", *TENSOR, *INVARIANTS):
        raise ArchiveError(
            f"'{name}': a component is x, y or z, as in {base}.x; of a tensor xx to zz, vonMises, "
            "pressure, det or size")
    return base, component


def usual_invariant(base):
    """What is drawn of a tensor where nothing is said."""
    word = base.lower()
    return "vonMises" if "stress" in word else "det" if "deformation" in word else "size"


def _invariant(t, which):
    """Of tensors t[9, ...], row after row."""
    trace = t[0] + t[4] + t[8]
    if which == "pressure":
        return -trace / 3
    if which == "size":
        return np.sqrt((t ** 2).sum(axis=0))
    if which == "det":
        return (t[0] * (t[4] * t[8] - t[5] * t[7]) - t[1] * (t[3] * t[8] - t[5] * t[6]) +
                t[2] * (t[3] * t[7] - t[4] * t[6]))
    deviator = t - np.reshape([1., 0, 0, 0, 1, 0, 0, 0, 1], (9,) + (1,) * (t.ndim - 1)) * trace / 3
    return np.sqrt(1.5 * (deviator ** 2).sum(axis=0))


def scalar(base, values, component, along=None):
    """One number a place of values[...] or values[component, ...] (the first axis has 3 or 9): the
    named component; else of a vector in 1-D the one along the line, else its size; of a tensor its
    usual invariant."""
    count = len(values) if values.ndim in (2, 4) else 1
    if count == 1:
        if component is not None:
            raise ArchiveError(f"'{base}' is not a vector: it has no components")
        return values
    if count == 9:
        component = component or usual_invariant(base)
        if component in TENSOR:
            return values[TENSOR.index(component)]
        if component in INVARIANTS:
            return _invariant(values, component)
        raise ArchiveError(f"'{base}' is a tensor: write {base}.xx to .zz, or .vonMises, "
                           ".pressure, .det, .size")
    if component is None and along is not None:
        component = "xyz"[along]
    if component in ("x", "y", "z"):
        return values["xyz".index(component)]
    if component not in (None, "size"):
        raise ArchiveError(f"'{base}' is a vector: write {base}.x, .y or .z")
    return np.sqrt((values ** 2).sum(axis=0))


def spoken(name, components):
    """The name of what is drawn: 'p.stress.vonMises' for 'p.stress'."""
    base, component = split_name(name)
    if components == 9 and component is None:
        return f"{base}.{usual_invariant(base)}"
    return name


def colour_range(numbers, size=0.0):
    """(low, high, map): around zero with a two-sided map when values take both signs; one colour
    where they are equal to round-off. size: of what such values could be, in the same unit."""
    low, high = float(np.min(numbers)), float(np.max(numbers))
    largest = max(abs(low), abs(high))
    if high - low <= ROUND_OFF * max(largest, size):
        pad = 0.1 * max(largest, size) or 1.0
        return low - pad, high + pad, "cividis"
    if low < 0 < high and min(-low, high) > SIGNED * largest:
        return -largest, largest, "PuOr"
    return low, high, "cividis"
