"""The options of pictures, one row each; `sluice plot` and `sluice movie` hand them on."""
import argparse
import pathlib

from . import levels

PICTURES, MOVIES = (".png", ".svg", ".pdf"), (".gif", ".mp4")


def plane(text):
    """'z=0.5' -> (2, 0.5)."""
    axis, equals, position = text.partition("=")
    try:
        if axis not in ("x", "y", "z") or not equals:
            raise ValueError
        return "xyz".index(axis), float(position)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}': write x=0.5, y=... or z=...") from None


def line(text):
    """'0,0,0:1,0,0' -> two points."""
    try:
        points = tuple(tuple(float(n) for n in part.split(",")) for part in text.split(":"))
        if [len(point) for point in points] != [3, 3]:
            raise ValueError
        return points
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"'{text}': write two points, x1,y1,z1:x2,y2,z2") from None


def value_range(text):
    """'0:3' -> (None, 0, 3); 'vel_CC=0:3' -> ('vel_CC', 0, 3)."""
    name, _, ends = text.rpartition("=")
    try:
        low, high = (float(end) for end in ends.split(":"))
        if not low < high:
            raise ValueError
        return name or None, low, high
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"'{text}': write LOW:HIGH or LABEL=LOW:HIGH with LOW below HIGH") from None


def contour_levels(text):
    """'8' -> 8 lines; '1e5,2e5' -> these values."""
    try:
        if "," not in text and float(text) == int(float(text)) and 0 < float(text) <= 100:
            return int(float(text))
        return sorted(float(part) for part in text.split(",") if part)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"'{text}': write a number of lines (1 to 100) or values a,b,...") from None


def size(text):
    """'8x5' -> inches."""
    try:
        width, height = (float(part) for part in text.lower().split("x"))
        if not (1 <= width <= 60 and 1 <= height <= 60):
            raise ValueError
        return width, height
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"'{text}': write width and height in inches, from 1 to 60: 8x5") from None


def positive(kind, low, high):
    def read(text):
        try:
            number = kind(text)
            if not low <= number <= high:
                raise ValueError
            return number
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"'{text}': write a number from {low:g} to {high:g}") from None
    return read


def colour_map(text):
    import matplotlib
    if text == "schlieren" or text in matplotlib.colormaps:
        return text
    import difflib
    near = difflib.get_close_matches(text, [*matplotlib.colormaps, "schlieren"], 3)
    raise argparse.ArgumentTypeError(
        f"'{text}' is no colour map" + (f"; did you mean {', '.join(near)}?" if near else "") +
        "; names are those of matplotlib (viridis, cividis, magma, coolwarm, ...) and schlieren")


class OneLine(argparse.ArgumentParser):
    """Faults in one line; `sluice plot --help` tells the options."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def parser_of(command):
    """An ArgumentParser for 'plot' or 'movie'."""
    parser = OneLine(prog=f"sluice {command}", description="Draw archives", allow_abbrev=False)
    add = parser.add_argument
    add("archives", nargs="+", metavar="UDA")
    add("--var", action="append", help="label, or a component: vel_CC.x, p.stress.xy")
    add("--material", help="name or number")
    add("--names", type=lambda text: [part.strip() for part in text.split(",")])
    add("--difference", action="store_true")
    add("--checkpoint", action="store_true", help="checkpoints, not outputs")
    add("--slice", type=plane, help="plane of a 3-D run, z=0.5")
    add("--line", type=line, help="profile between two points x1,y1,z1:x2,y2,z2")
    add("--radius", action="store_true",
        help="every cell of a 2-D or 3-D run against its distance from the origin")
    add("--levels", choices=levels.KINDS, default=levels.KINDS[0],
        help="what is drawn of finer levels: their outer edges (default), their boxes, the tiles "
        "of the regridder, or none of it")
    add("--range", action="append", type=value_range, default=[])
    add("--log", action="store_true")
    add("--cmap", type=colour_map)
    add("--contours", type=contour_levels)
    add("--arrows", type=positive(int, 1, 200))
    add("--particles", help="particles over the plane, coloured by this label of theirs; p.x: in "
        "the colours of their materials; none")
    add("--outline", action="store_true")
    add("--paths", type=positive(int, 1, 100000), metavar="N")
    add("--title")
    add("--size", type=size)
    add("--dpi", type=positive(float, 20, 1200))
    if command == "plot":
        add("--time", action="append", help="last, first, #N or a time; several")
        add("--history", action="append", help="a history, a sample of DataAnalysis, levels or "
            "effects")
        add("--exact", help="CSV with x and one column a variable, drawn as a line")
        add("-o", "--output", default="picture.png")
    else:
        add("--from", dest="first", default="first")
        add("--to", dest="last", default="last")
        add("--every", type=positive(int, 1, 1 << 30), default=1)
        add("--fps", type=positive(float, 0.1, 120), default=10.0)
        add("-o", "--output", default="movie.gif")
    return parser


def parse(command, arguments):
    parser = parser_of(command)
    given = parser.parse_args(arguments)
    given.normal, given.position = given.slice or (None, None)
    endings = PICTURES if command == "plot" else MOVIES
    if pathlib.Path(given.output).suffix not in endings:
        what = "a picture" if command == "plot" else "a movie"
        parser.error(f"'{given.output}': the name of {what} ends in " +
                     ", ".join(endings[:-1]) + f" or {endings[-1]}")
    if given.line and (given.radius or given.slice):
        parser.error("--line goes without --slice and --radius")
    return given
