"""The plane of runs in three dimensions: most materials, most particles, nearest the middle."""
import types
import unittest
from unittest import mock

import numpy as np

from sluice_tools import default_plane


def step(cells, clouds):
    """A domain of unit cells from (0, 0, 0); particles of each material."""
    level = types.SimpleNamespace(lower=(0, 0, 0), upper=cells, anchor=(0., 0., 0.),
                                  spacing=(1., 1., 1.))
    return types.SimpleNamespace(
        levels=[level], particle_materials=lambda: sorted(clouds),
        particles=lambda material, wanted: {"p.x": np.array(clouds[material], dtype=float)})


class Planes(unittest.TestCase):
    def setUp(self):
        self.enterContext(mock.patch.object(default_plane.quantities, "fluids", lambda _: []))

    def best(self, cells, clouds):
        return default_plane.best(step(cells, clouds))

    def test_without_particles_it_is_the_middle_across_z(self):
        self.assertEqual(self.best((4, 4, 4), {}), (2, 2.5))
        self.assertEqual(self.best((5, 5, 5), {}), (2, 2.5))

    def test_planes_with_most_cells_are_taken(self):
        self.assertEqual(self.best((4, 9, 9), {})[0], 0)
        self.assertEqual(self.best((9, 4, 9), {})[0], 1)

    def test_the_layer_with_most_materials_goes_before_that_with_most_particles(self):
        both = {0: [(1, 1, 0.5)] * 9 + [(1, 1, 3.5)], 1: [(2, 2, 3.5)]}
        self.assertEqual(self.best((4, 4, 4), both), (2, 3.5))

    def test_then_most_particles_then_the_middle(self):
        one = {0: [(1.5, 1.5, z) for z in (0.5, 0.6, 2.5, 3.5)]}
        self.assertEqual(self.best((4, 4, 4), one), (2, 0.5))
        spread = {0: [(1.5, 1.5, z + 0.5) for z in range(5)]}
        self.assertEqual(self.best((5, 5, 5), spread), (2, 2.5))


if __name__ == "__main__":
    unittest.main()
