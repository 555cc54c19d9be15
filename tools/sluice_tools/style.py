"""How our pictures look: colours that colour-blind readers tell apart and that print in grey."""
import contextlib
import sys

from .scalars import split_name

# Okabe and Ito's palette, darkest and most distinct first.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
LINES = ["-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2))]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]

SETTINGS = {
    "figure.dpi": 150, "savefig.dpi": 150, "figure.constrained_layout.use": True,
    "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9, "legend.fontsize": 8,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.2,
    "legend.frameon": False, "svg.fonttype": "none", "image.cmap": "cividis",
}

# What a reader calls the common labels.
WORDS = {
    "rho_CC": "density", "press_CC": "pressure", "press_equil_CC": "equilibration pressure",
    "vel_CC": "velocity", "temp_CC": "temperature", "sp_vol_CC": "specific volume",
    "vol_frac_CC": "volume fraction", "speedSound_CC": "sound speed",
    "mag_grad_rho_CC": "density gradient", "vorticity": "vorticity",
    "sum_rho_CC": "density of all materials",
    "p.stress": "stress", "p.velocity": "velocity", "p.temperature": "temperature",
    "p.displacement": "displacement", "p.color": "colour", "p.x": "particles",
    "p.deformationMeasure": "deformation gradient",
}
# Of the cell, whatever the material they are stored for.
COMMON = {"press_CC", "press_equil_CC", "sum_rho_CC"}


def caption(name, unit):
    base, component = split_name(name)
    text = WORDS.get(base, base)
    if component:
        text += {"vonMises": ", von Mises", "det": ", determinant"}.get(component, " " + component)
    return f"{text}  ({unit_text(unit)})" if unit and unit != "1" else text


def unit_text(unit):
    for plain, raised in (("^2", "²"), ("^3", "³"), ("^-1", "⁻¹"), ("*", " ")):
        unit = unit.replace(plain, raised)
    return unit


@contextlib.contextmanager
def pyplot():
    """matplotlib.pyplot with our settings and without a screen."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    with plt.rc_context(SETTINGS):
        yield plt
        plt.close("all")


def save_picture(tool, draw, output, bad_input):
    """Saves the figure draw(pyplot) and tells so; the exit status, 2 where bad_input was raised."""
    try:
        with pyplot() as plt:
            draw(plt).savefig(output)
    except (bad_input, OSError) as error:
        print(f"{tool}: {error}", file=sys.stderr)
        return 2 if isinstance(error, bad_input) else 3
    print(f"picture: {output}")
    return 0
