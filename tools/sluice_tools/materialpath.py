"""Draw the path of one particle of a material: stresses, energy and temperature over time, and
equivalent stress over strain.

    python3 -m sluice_tools materialpath PATH.csv -o PICTURE [--title TEXT]

PATH.csv is the CSV of `sluice drive`.
"""
import argparse
import csv
import sys

import numpy

from . import style


def read(path):
    """Columns by name, as arrays."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def equivalent_strain(table):
    """(2/3 dev E : dev E)^(1/2) of the logarithmic strain E = ln(F F^T)/2."""
    axes = "xyz"
    F = numpy.array([[table[f"F_{a}{b}"] for b in axes] for a in axes]).transpose(2, 0, 1)
    values = numpy.linalg.eigvalsh(F @ F.transpose(0, 2, 1))
    logs = 0.5 * numpy.log(values)
    deviators = logs - logs.mean(axis=1, keepdims=True)
    return numpy.sqrt(2 / 3 * (deviators ** 2).sum(axis=1))


def draw(table, picture, title):
    """Four frames in one picture."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    with pyplot.rc_context(style.SETTINGS):
        figure, frames = pyplot.subplots(2, 2, figsize=(9, 6.5))
        time = table["time"]
        for n, part in enumerate(("xx", "yy", "zz", "yz", "xz", "xy")):
            values = table[f"stress_{part}"]
            if numpy.any(values != 0):
                frames[0, 0].plot(time, values, linestyle=style.LINES[n % len(style.LINES)],
                                  color=style.COLOURS[n], label=part)
        frames[0, 0].set(xlabel="time (s)", ylabel="stress (Pa)")
        if frames[0, 0].lines:
            frames[0, 0].legend(ncol=3)
        frames[0, 1].plot(equivalent_strain(table), table["equivalent_stress"],
                          color=style.COLOURS[0])
        frames[0, 1].set(xlabel="equivalent logarithmic strain", ylabel="equivalent stress (Pa)")
        frames[1, 0].plot(time, table["energy"], color=style.COLOURS[0])
        frames[1, 0].set(xlabel="time (s)", ylabel="work of the stress (J/m$^3$)")
        frames[1, 1].plot(time, table["temperature"], color=style.COLOURS[1])
        frames[1, 1].set(xlabel="time (s)", ylabel="temperature (K)")
        figure.suptitle(title)
        figure.savefig(picture)
        pyplot.close(figure)


def main(words):
    """The exit status."""
    parser = argparse.ArgumentParser(prog="sluice drive", description=__doc__)
    parser.add_argument("path")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--title", default="")
    options = parser.parse_args(words)
    try:
        draw(read(options.path), options.output, options.title)
    except (OSError, ValueError) as error:
        print(f"sluice drive: error: {error}", file=sys.stderr)
        return 2
    return 0
