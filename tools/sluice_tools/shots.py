"""What one picture shows together: archives at times, each with its name in the legend."""
import functools

import numpy as np

from . import default_plane, materials, particles, quantities, sampling, views
from .archive import Archive, ArchiveError


def _kept(method):
    """What a method of a Shot has found for a label stays with the Shot."""
    @functools.wraps(method)
    def found(self, name):
        key = (method.__name__, name)
        if key not in self.kept:
            self.kept[key] = method(self, name)
        return self.kept[key]
    return found


class Shot:
    """One output of one archive, with what a picture asks of it. Read once, kept while drawn."""

    def __init__(self, archive, step, given, label="", number=0):
        self.archive, self.step, self.label, self.number = archive, step, label, number
        self.kept = {}
        self.window = None  # of pictures of particles; None: what their bodies take
        self.material = None
        if given.material is not None:
            self.material = materials.number(archive, given.material)
        self.given = given
        self.normal, self.position = given.normal, given.position
        if len(self.directions) == 3 and self.position is None:
            self.normal, self.position = default_plane.best(step)

    @property
    def directions(self):
        return self.step.levels[0].active_directions()

    @property
    def is_line(self):
        """Drawn as profiles: a run in one direction, a line through another, cells by radius."""
        return len(self.directions) == 1 or self.given.radius or self.given.line is not None

    def is_of_particles(self, name):
        return name != quantities.SCHLIEREN and particles.is_of_particles(self.archive, name)

    @property
    def plane_at(self):
        """(normal, position) of the plane of pictures."""
        normal = views.plane_axes(self.step, self.normal)[2]
        return normal, views.plane_position(self.step, normal, self.position)

    @_kept
    def sheets(self, name):
        return views.plane(self.step, name, self.material, self.normal, self.position)

    @_kept
    def cuts(self, name):
        """[particles.Cut] of each material that has this label."""
        base = particles.base_of(name)
        return [particles.Cut(self, name, m) for m in particles.materials_of(self, base)]

    @_kept
    def lines(self, name):
        """[(material or None, positions, values)]: profiles, each place once."""
        step, given = self.step, self.given
        if given.line:
            x, values, _ = sampling.along_line(step, name, *given.line, self.material)
            return [(None, x, values)]
        if self.is_of_particles(name):
            return [(m, x, values) for m, x, values in particles.line(self, name)]
        return [(m, *views.line(step, name, m)[:2])
                for m in line_materials(step, name, self.material)]

    def numbers(self, name):
        """All values that a picture of this label shows."""
        if not self.is_line and self.is_of_particles(name):
            parts = [cut.numbers for cut in self.cuts(name)]
        elif not self.is_line:
            parts = [sheet[~hidden & np.isfinite(sheet)] for *_, sheet, hidden in self.sheets(name)]
        elif self.given.radius:
            parts = [values for *_, values in views.radii(self.step, name, self.material)]
        else:
            parts = [values[np.isfinite(values)] for *_, values in self.lines(name)]
        return np.concatenate(parts) if parts else np.zeros(0)


def window_of(shot, name):
    """What a picture of particles shows: [(low, high)] of both axes, None without particles."""
    cuts = [cut for cut in shot.cuts(name) if len(cut.corners)]
    return particles.window_of(shot, cuts) if cuts else None


def line_materials(step, name, material=None):
    """The materials that a profile shows: the one asked for; the one or the whole where all have
    the same; else each where it is."""
    base = quantities.label_of(step, name)
    if material is not None or base in quantities.COMMON:
        return [material]
    there = step.materials(base)
    if len(there) < 2 or name == quantities.SCHLIEREN:
        return [None]
    found = [list(views.profiles(step, name, m)) for m in there]
    if all(np.array_equal(a[2], b[2], equal_nan=True)
           for parts in found[1:] for a, b in zip(found[0], parts)):
        return [there[0]]
    return there


def _short(archive):
    return archive.path.name.split(".uda")[0]


def _archive_labels(archives, given):
    if given.names and len(given.names) != len(archives):
        raise ArchiveError(f"--names {','.join(given.names)}: {len(given.names)} names for "
                           f"{len(archives)} archives")
    labels = given.names or [_short(a) for a in archives]
    if len(set(labels)) < len(labels):
        labels = [a.path.name for a in archives]
    if len(set(labels)) < len(labels):
        labels = [str(a.path) for a in archives]
    return labels


def open_archives(given):
    """[(archive, its name in the legend)]."""
    archives = [Archive(path, given.checkpoint) for path in given.archives]
    return list(zip(archives, _archive_labels(archives, given)))


def of_outputs(outputs, given):
    """Shots of [(archive, its name, step)]."""
    several_archives = len({name for _, name, _ in outputs}) > 1
    several_times = len({step.time for *_, step in outputs}) > 1
    shots = []
    for number, (archive, name, step) in enumerate(outputs):
        words = [name] if several_archives else []
        if several_times:
            words.append(f"t = {step.time:.6g} s")
        shots.append(Shot(archive, step, given, ", ".join(words), number))
    for shot in shots[1:]:  # one plane for all
        shot.normal, shot.position = shots[0].normal, shots[0].position
    return shots


def gather(given):
    """All shots of a picture, archive by archive, time by time."""
    times = given.time or ["last"]
    outputs = [(archive, name, archive.step(time)) for archive, name in open_archives(given)
               for time in times]
    views.check_slice(outputs[0][2], given.normal, given.position)
    if given.difference and len(outputs) != 2:
        raise ArchiveError(f"--difference needs two archives, or one and two times; given: "
                           f"{len(outputs)}")
    return of_outputs(outputs, given)
