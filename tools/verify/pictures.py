#!/usr/bin/env python3
"""Default pictures against what the archives hold: every material covers its share of the plane,
within LIMIT both ways, counted in pixels.

    pictures.py --sluice PROGRAM --folder FOLDER [--test]

Runs the decks of DECKS (those of the public suite where SLUICE_DECKS names its folder; --test: the
quick ones of our own), draws the default picture of each and of each material, and counts. Pictures
stay in FOLDER. Exit status 0, 1 where a share is off, 77 where nothing could be checked.
"""
import argparse
import os
import pathlib
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from sluice_tools import (materials, options, planes, plot, quantities,  # noqa: E402
                          shots as all_shots, style, views)

LIMIT = 0.05
SMALLEST = 0.01  # of the plane: less than that is a few pixels
OUR = [ROOT / "inputs/ice/helium_bubble.ups", ROOT / "inputs/mpmice/shock_over_foam.ups"]
PUBLIC = ["inputs/UintahRelease/MPM/taylorImpact.ups", "inputs/MPM/Impact/cylinderImpact_A_JC.ups",
          "inputs/MPMICE/guni2dRT.ups"]


def run(sluice, deck, folder, where, more=()):
    """The archive of a run; `where` is the folder in which the files that decks name are found."""
    command = [sluice, "run", str(deck), "-o", str(folder), "--progress", "none", "--quiet", *more]
    ended = subprocess.run(command, cwd=where, capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit {ended.returncode}\n{ended.stdout[-2000:]}"
                         f"{ended.stderr[-2000:]}")
    return folder / (pathlib.Path(deck).stem + ".uda")


def with_label(deck, label, folder):
    """A copy of a deck that also saves a label: what is saved changes no result."""
    text = pathlib.Path(deck).read_text(encoding="utf-8")
    copy = folder / pathlib.Path(deck).name
    folder.mkdir(parents=True, exist_ok=True)
    copy.write_text(text.replace("</DataArchiver>", f'<save label="{label}"/></DataArchiver>', 1),
                    encoding="utf-8")
    return copy


class Picture:
    """The first panel of a default picture in pixels."""

    def __init__(self, archive, output, *words):
        given = plot.parse([str(archive), "-o", str(output), *words])
        self.shot = all_shots.gather(given)[0]
        with style.pyplot() as plt:
            figure = plot.draw(given, plt)
            figure.savefig(output)
            figure.canvas.draw()
            whole = np.array(figure.canvas.buffer_rgba())[::-1, :, :3].astype(float) / 255
            ax = figure.axes[0]
            box = ax.get_window_extent()
            # A pixel less at each side: frames are drawn there.
            self.pixels = whole[round(box.y0) + 2:round(box.y1) - 1,
                                round(box.x0) + 2:round(box.x1) - 1]
            self.window = [*ax.get_xlim(), *ax.get_ylim()]

    def area(self):
        x0, x1, y0, y1 = self.window
        return (x1 - x0) * (y1 - y0)

    def near(self, colour):
        from matplotlib.colors import to_rgb
        return np.abs(self.pixels - np.array(to_rgb(colour))).max(axis=2) < 0.06

    def white(self):
        return self.near("white")

    def of_solid(self, material):
        """Share of its colour, and half of the dark outline beside it."""
        own = self.near(style.solid_colour(material))
        beside = own.copy()
        for _ in range(2):
            for axis in (0, 1):
                beside = beside | np.roll(beside, 1, axis) | np.roll(beside, -1, axis)
        line = beside & ~own & (self.pixels.max(axis=2) < 0.5)
        return (own.sum() + 0.5 * line.sum()) / own.size

    def inside_line(self, colour):
        """Share of what lines of this colour enclose and of half of the lines: all that the paint
        poured in at the largest part outside does not reach."""
        line = self.near(colour)
        for axis in (0, 1):  # closed at corners
            line = line | np.roll(line, 1, axis)
        label = regions(~line)
        largest = np.bincount(label[label > 0]).argmax()
        inside = (label > 0) & (label != largest)
        return (inside.sum() + 0.5 * line.sum()) / inside.size


def regions(free):
    """Numbers from 1 of connected parts of True; 0 elsewhere."""
    from PIL import Image, ImageDraw
    image = Image.fromarray(np.where(free, 0, 1).astype("int32"), mode="I")
    number = 2
    while True:
        found = np.argwhere(np.asarray(image) == 0)
        if not len(found):
            break
        ImageDraw.floodfill(image, (int(found[0][1]), int(found[0][0])), number)
        number += 1
    label = np.asarray(image).copy()
    label[label == 1] = 0
    return np.maximum(label - 1, 0)


def true_solid_area(shot, material, volumes_of):
    """Area of a material in the plane: volumes of the particles in the plane's layer of cells over
    its thickness, m^2."""
    step = volumes_of or shot.step
    table = step.particles(material, {"p.x", "p.volume", "p.mass"})
    if "p.volume" in table:
        volumes = table["p.volume"]
    else:
        element = materials.elements(shot.archive)[material][1]
        volumes = table["p.mass"] / float(element.findtext("density"))
    normal, position = shot.plane_at
    near = views.near_plane(step, table["p.x"], normal, position)
    return volumes[near].sum() / step.levels[0].spacing[normal]


def true_fluid_area(shot, material):
    field = shot.step.field("vol_frac_CC", material)
    normal, position = shot.plane_at
    first, second, _ = views.plane_axes(shot.step, normal)
    index = views.layer(field.level, normal, position) - field.lower[normal]
    cell = field.level.spacing[first] * field.level.spacing[second]
    return np.take(field.values, index, axis=normal).sum() * cell


class Check:
    def __init__(self):
        self.failed = 0

    def share(self, what, drawn, true):
        off = drawn / true - 1 if true > 0 else 0.0
        small = true < SMALLEST
        good = small or abs(off) <= LIMIT
        self.failed += not good
        verdict = "  (too small to count)" if small else "" if good else "  BAD"
        print(f"  {what:32} drawn {100 * drawn:6.2f} %  is {100 * true:6.2f} %  off "
              f"{100 * off:+5.1f} %{verdict}", flush=True)


def check_archive(archive, folder, check, volumes_of=None):
    name = archive.name.split(".uda")[0]
    print(name)
    whole = Picture(archive, folder / f"{name}.png")
    shot = whole.shot
    solids, fluids = shot.step.particle_materials(), quantities.fluids(shot.step)
    spoken = materials.names(shot.archive)
    areas = {m: true_solid_area(shot, m, volumes_of) / whole.area() for m in solids}
    if fluids:
        for m in solids:
            check.share(spoken[m], whole.of_solid(m), areas[m])
        solid = sum(whole.of_solid(m) for m in solids)
        check.share("all fluids", 1 - whole.white().mean() - solid, 1 - sum(areas.values()))
        lines = planes.interfaces(shot)
        for number, (m, *_) in enumerate(lines if not solids else ()):
            check.share(f"{spoken[m]}, inside its line",
                        whole.inside_line(planes.INTERFACES[number]),
                        true_fluid_area(shot, m) / whole.area())
        return
    for m in solids:
        alone = Picture(archive, folder / f"{name}_{m}.png", "--material", str(m), "--slice",
                        f"{'xyz'[shot.plane_at[0]]}={shot.plane_at[1]:.17g}") \
            if len(shot.directions) == 3 else \
            Picture(archive, folder / f"{name}_{m}.png", "--material", str(m))
        check.share(f"{spoken[m]}, alone", 1 - alone.white().mean(),
                    areas[m] * whole.area() / alone.area())
    together = 1 - whole.white().mean()
    if not 0.95 * max(areas.values()) <= together <= 1.05 * sum(areas.values()):
        check.failed += 1
        print(f"  all together: {100 * together:.2f} % BAD")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--test", action="store_true")
    given = parser.parse_args()
    sluice = str(pathlib.Path(given.sluice).resolve())
    given.folder.mkdir(parents=True, exist_ok=True)
    folder = given.folder.resolve()
    check = Check()
    for deck in OUR:
        archive = run(sluice, deck, folder, folder)
        volumes_of = None
        if "foam" in deck.name:
            more = run(sluice, with_label(deck, "p.volume", folder / "volumes"),
                       folder / "volumes", folder)
            from sluice_tools.archive import Archive
            volumes_of = Archive(more).step()
        check_archive(archive, folder, check, volumes_of)
    decks = os.environ.get("SLUICE_DECKS")
    if not given.test and decks:
        for deck in PUBLIC:
            check_archive(run(sluice, deck, folder, decks), folder, check)
    elif not given.test:
        print("skipped: the decks of the public suite (SLUICE_DECKS names no folder)")
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main())
