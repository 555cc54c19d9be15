"""Small archives with several materials, for tests of pictures and of Python users' functions."""
import numpy as np

from sluice_tools.archive import Archive
from sluice_tools.test_archive import OnDisk, Writer

DECK = """<Uintah_specification><Meta><title>{title}</title></Meta><MaterialProperties>
  <MPM><material name="steel"><constitutive_model type="comp_neo_hook"><bulk_modulus>1e9
  </bulk_modulus></constitutive_model><density>8000</density><geom_object><res>[2,2,1]</res>
  </geom_object></material></MPM>
  <ICE><material name="helium"/><material name="air"/></ICE>
</MaterialProperties></Uintah_specification>"""

ANCHOR = np.array([1.0, 2.0, 0.0])  # of all small archives
RADIUS = 0.6  # of the bubble of helium, around its middle
MIDDLE = np.array([1.0, 3.0])  # on the low side of x


def in_bubble(x, y):
    return np.hypot(x - MIDDLE[0], y - MIDDLE[1]) < RADIUS


class Scenes(OnDisk):
    """Fields over 2 m x 2 m; helium in a half disk, air elsewhere, steel in a square."""

    def bubble(self, cells=40, title="A bubble", particles=False):
        size = 2.0 / cells
        writer = Writer(self.root, [((size, size, 0.1), (0, 0, 0), (cells, cells, 1),
                                     [((0, 0, 0), (cells, cells, 1))])])
        shares = [lambda x, y, z: 1.0 * in_bubble(x, y), lambda x, y, z: 1.0 - in_bubble(x, y)]
        density, temperature, speed = (0.2, 1.2), (400.0, 300.0), (5.0, 1.0)
        for n, share in enumerate(shares):
            def times(value, share=share):
                return lambda x, y, z: value * share(x, y, z)
            writer.add("vol_frac_CC", "CC", [share], 1 + n)
            writer.add("rho_CC", "CC", [times(density[n])], 1 + n)
            writer.add("temp_CC", "CC", [times(temperature[n])], 1 + n)
            writer.add("vel_CC", "CC", [times(speed[n]), times(0), times(0)], 1 + n)
        writer.add("press_CC", "CC", [lambda x, y, z: 1e5 + 0 * x])
        if particles:
            self.add_square(writer, size)
        writer.close()
        (self.root / "input.xml").write_text(DECK.format(title=title), encoding="utf-8")
        return Archive(self.root)

    SQUARE = (2.0, 2.6, 2.4, 3.2)  # of steel: x from, to, y from, to

    def add_square(self, writer, size):
        x0, x1, y0, y1 = self.SQUARE
        half = 0.5 * size
        xs, ys = (np.arange(a + 0.5 * half, b, half) for a, b in ((x0, x1), (y0, y1)))
        rows = [(n + 1, x, y, 0.05, half * half * 0.1, *(1e6 * x if c in (0, 4, 8) else 0
                                                         for c in range(9)))
                for n, (x, y) in enumerate((x, y) for x in xs for y in ys)]
        writer.add_particles(0, [rows], 0, (("p.volume", "double", 1), ("p.stress", "Matrix3", 9)))
