"""A run for programs of users: its outputs, fields, levels, particles, histories and probes.

    run = sluice_tools.open("foam.uda")
    run.times, run.materials, run.labels       # [0.0, ...], {0: "foam"}, {"press_CC": "Pa"}
    out = run["last"]                          # also run[3], run["first"], run.at(1e-3)
    out.field("press_CC")                      # Field: .values, .coordinates(d); NaN without a box
    out.particles("foam")["p.stress"]          # arrays [n], vectors [n, 3], tensors [n, 3, 3]
    out.sample("vel_CC", points)               # on the finest level there
    out.covering_grid("press_CC", level=1)     # the domain on the cells of a level
    run.series("press_CC", points)             # times [n], values [n, point]
    run.history("TotalMass"), run.probe("ahead")
    out.to_yt()                                # a data set of yt

Materials are given by name or number. Units are those of the deck (SI), see `run.labels`. What is
not there raises sluice_tools.archive.ArchiveError, with what there is.
"""
import numpy as np

from . import materials, quantities, sampling, samples, views
from .archive import Archive, ArchiveError


class Run:
    """An archive. Outputs are read when they are asked for."""

    def __init__(self, path):
        self.archive = Archive(path)
        self.path = self.archive.path
        self.title = self.archive.title()
        self.materials = materials.names(self.archive)
        self.labels = {name: v.unit for name, v in sorted(self.archive.variables.items())}
        self.times = [time for _, time, _ in self.archive.steps]

    def __len__(self):
        return len(self.times)

    def __getitem__(self, which):
        """An output by its number (negative: from the end), or 'first' or 'last'."""
        if isinstance(which, (int, np.integer)):
            if not -len(self) <= which < len(self):
                raise IndexError(f"output {which}: there are {len(self)}")
            return Output(self, self.archive.step(f"#{which % len(self)}"))
        return Output(self, self.archive.step(which))

    def __iter__(self):
        return (self[n] for n in range(len(self)))

    def at(self, time):
        """The output nearest to a time, s; an error when that is further away than half an interval
        between outputs."""
        return Output(self, self.archive.step(repr(float(time))))

    def series(self, label, points, material=None):
        """(times [n], values [n, point, ...]) of a label at points [point, 3] in all outputs."""
        return np.array(self.times), np.stack([out.sample(label, points, material)
                                               for out in self])

    @property
    def samples(self):
        """{name: kind} of histories and samples of <DataAnalysis>, as `sluice info` lists them."""
        return {name: s.kind for name, s in samples.catalogue(self.archive).items()}

    def history(self, name, time=None):
        """{column: array} of a history or a sample; of planes and averages at the sampled time
        nearest to `time` (None: the last)."""
        table = samples.read(samples.find(self.archive, name), time)
        return {column: table.rows[:, n] for n, column in enumerate(table.columns)}

    def probe(self, name):
        """The columns of a point of <Module name="pointExtract">."""
        return self.history(f"points/{name}")


class Output:
    """What was saved at one time."""

    def __init__(self, run, step):
        self.run, self.step = run, step
        self.time, self.number = step.time, step.number
        self.levels = step.levels

    def _number(self, material):
        return None if material is None else materials.number(self.run.archive, material)

    @property
    def labels(self):
        """{label: names of the materials that have it}."""
        names = self.run.materials
        return {label: [names[m] for m in self.step.materials(label)]
                for label in self.step.names()}

    def field(self, label, material=None, level=0):
        """The stored values on a level as a Field: .values [i, j, k], of vectors and tensors
        [component, i, j, k], and .coordinates(direction), m. Without a material: of the first."""
        return self.step.field(label, self._number(material), level)

    def scalar(self, label, material=None, level=0):
        """One number per cell, as pictures show it: of the whole without a material (density,
        velocity and temperature of all materials); NaN where a material is not. A label may have a
        component: 'vel_CC.x', 'p.stress.vonMises', 'schlieren'."""
        return quantities.level_field(self.step, label, self._number(material), level)

    def particles(self, material=None, labels=None):
        """{label: array} of all particles of a material by their numbers: [n], vectors [n, 3],
        tensors [n, 3, 3]. labels: only these, with p.particleID."""
        table = self.step.particles(self._number(material), set(labels) if labels else None)
        return {label: values.reshape(-1, 3, 3) if values.shape[1:] == (9,) else values
                for label, values in table.items()}

    def sample(self, label, points, material=None):
        """Values at points [n, 3] (m), each of the finest cell that holds it: [n], vectors [n, 3],
        tensors [n, 9]; NaN outside, and where the material is not."""
        return sampling.sample(self.step, label, points, self._number(material))

    def line(self, label, first, last, material=None):
        """(distances [n] from the first point, values [n]) along a straight line through the
        cells."""
        return sampling.along_line(self.step, label, first, last, self._number(material))[:2]

    def covering_grid(self, label, level=0, material=None):
        """((x, y, z), values [i, j, k]) of the whole domain on the cells of a level: its own
        values, elsewhere those of the coarser cells. Finer levels are not looked at: cells below
        them hold their means."""
        return covering_grid(self.step, label, level, self._number(material))

    def to_yt(self, labels=None):
        """A data set of yt with all levels and all fields of cells (or those named); needs yt."""
        from .to_yt import to_yt
        return to_yt(self, labels)


def covering_grid(step, label, level, material=None):
    if not 0 <= level < len(step.levels):
        raise ArchiveError(f"there is no level {level}: there are {len(step.levels)}")
    stored = [n for n in views.stored_levels(step, label, material) if n <= level]
    if not stored:
        raise ArchiveError(f"'{label}' is stored on no level up to {level}")
    target = step.levels[level]
    centres = [target.anchor[d] + (np.arange(target.lower[d], target.upper[d]) + 0.5)
               * target.spacing[d] for d in range(3)]
    values = np.full([len(axis) for axis in centres], np.nan)
    for n in stored:
        field = quantities.level_field(step, label, material, n)
        if field.variable.centring != "cell":
            raise ArchiveError(f"'{label}' is not a label of cells")
        index = [np.floor((centres[d] - field.level.anchor[d]) / field.level.spacing[d]).astype(int)
                 - field.lower[d] for d in range(3)]
        kept = [np.nonzero((i >= 0) & (i < field.values.shape[d]))[0]
                for d, i in enumerate(index)]
        source = np.ix_(*(index[d][kept[d]] for d in range(3)))
        inside = sampling.boxes_of(field)[source]
        into = np.ix_(*kept)
        values[into] = np.where(inside, field.values[source], values[into])
    return tuple(centres), values
