"""How our pictures look: colours that colour-blind readers tell apart and that print in grey."""
import contextlib
import sys

from .scalars import split_name

# Okabe and Ito's palette, darkest and most distinct first.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
# Of solids, unlike any colour of the maps of fields.
SOLIDS = ["#009E73", "#CC79A7", "#D55E00", "#56B4E9", "#000000", "#F0E442"]
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
    "rho_micro_CC": "true density", "schlieren": "|grad density|",
    "solid.fraction": "volume fraction of solids",
    "p.stress": "stress", "p.velocity": "velocity", "p.temperature": "temperature",
    "p.displacement": "displacement", "p.color": "colour", "p.x": "particles",
    "p.deformationMeasure": "deformation gradient",
}
def solid_colour(material):
    return SOLIDS[material % len(SOLIDS)]


def words(name):
    """What a reader calls a label or a component of it."""
    base, component = split_name(name)
    text = WORDS.get(base, base)
    if component:
        text += {"vonMises": ", von Mises", "det": ", determinant",
                 "size": " magnitude"}.get(component, " " + component)
    return text


def with_unit(text, unit):
    return f"{text}  ({unit_text(unit)})" if unit and unit != "1" else text


def unit_text(unit):
    for plain, raised in (("^2", "²"), ("^3", "³"), ("^4", "⁴"), ("^-1", "⁻¹"), ("*", " ")):
        unit = unit.replace(plain, raised)
    return unit


def colour_bar(fig, ax, drawn, unit):
    """Inset, so that the bar is as high as a plane drawn in its own proportions."""
    bar = fig.colorbar(drawn, cax=ax.inset_axes([1.03, 0, 0.035, 1]))
    bar.outline.set_linewidth(0.4)
    if hasattr(bar.formatter, "set_powerlimits"):
        bar.formatter.set_powerlimits((-3, 5))
    if unit and unit != "1":
        bar.set_label(unit_text(unit))
    return bar


def misplaced_texts(fig):
    """What a reader could not read: texts that leave the figure, titles over each other, numbers of
    an axis over each other. For tests; the figure has been drawn."""
    renderer = fig.canvas.get_renderer()
    inside = fig.bbox.padded(1.0)
    found, titles, beyond = [], [], set()
    for ax in [ax for ax in fig.findobj(lambda a: hasattr(a, "get_xticklabels"))
               if ax.get_visible()]:
        titles += [t for t in (ax.title, ax._left_title) if t.get_text()]
        for axis, ends in ((ax.xaxis, (0, 2)), (ax.yaxis, (1, 3))):
            labels = [t for t in axis.get_ticklabels() if t.get_text()]
            beyond |= {t for t in labels if not _is_shown(t, axis)}
            boxes = [t.get_window_extent(renderer).extents[list(ends)] for t in labels
                     if t not in beyond]
            boxes.sort(key=lambda box: box[0])
            if any(a[1] > b[0] + 1 for a, b in zip(boxes, boxes[1:])):
                found.append(f"numbers of {ax.get_title(loc='left') or 'an axis'} overlap")
    for text in fig.findobj(lambda a: hasattr(a, "get_text") and hasattr(a, "get_rotation")):
        if text in beyond or not text.get_visible() or not text.get_text().strip():
            continue
        box = text.get_window_extent(renderer)
        if not (inside.contains(box.x0, box.y0) and inside.contains(box.x1, box.y1)):
            found.append(f"'{text.get_text()}' leaves the figure")
    boxes = [(t.get_text(), t.get_window_extent(renderer)) for t in titles]
    for n, (text, box) in enumerate(boxes):
        found += [f"'{text}' lies over '{other}'" for other, theirs in boxes[:n]
                  if box.overlaps(theirs)]
    return found


def _is_shown(label, axis):
    """Ticks outside of the view keep a label that is not drawn."""
    low, high = sorted(axis.get_view_interval())
    place = label.get_position()[0 if axis.axis_name == "x" else 1]
    return low <= place <= high


def fit_text(text, inches):
    """Breaks a text into lines of at most this width, or shrinks it where a word is wider."""
    figure = text.get_figure()
    renderer = figure.canvas.get_renderer()

    def width(words):
        text.set_text(words)
        return text.get_window_extent(renderer).width / figure.dpi
    lines = [""]
    for word in text.get_text().split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and width(longer) > inches:
            lines.append(word)
        else:
            lines[-1] = longer
    widest = max(width(line) for line in lines)
    text.set_text("\n".join(line.strip() for line in lines))
    if widest > inches:
        text.set_fontsize(max(4.0, text.get_fontsize() * inches / widest))


def add_legend(fig, handles):
    """Below all panels, in as many columns as fit."""
    if not handles:
        return
    widest = max(len(handle.get_label()) for handle in handles)
    columns = max(1, min(len(handles), int(fig.get_figwidth() / (0.062 * widest + 0.55))))
    rows = -(-len(handles) // columns)
    room = (0.2 * rows + 0.1) / fig.get_figheight()
    fig.legend(handles=handles, loc="lower left", ncol=columns, borderaxespad=0.3)
    fig.get_layout_engine().set(rect=(0, room, 1, 1 - room))


@contextlib.contextmanager
def pyplot():
    """matplotlib.pyplot with our settings and without a screen."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    with plt.rc_context(SETTINGS):
        yield plt
        plt.close("all")


def save_picture(tool, draw, output, bad_input, dpi=None):
    """Saves the figure draw(pyplot) and tells so; the exit status, 2 where bad_input was raised."""
    try:
        with pyplot() as plt:
            figure = draw(plt)
            figure.savefig(output, **({"dpi": dpi} if dpi else {}))
    except (bad_input, OSError) as error:
        print(f"{tool}: {error}", file=sys.stderr)
        return 2 if isinstance(error, bad_input) else 3
    print(f"picture: {output}")
    return 0
