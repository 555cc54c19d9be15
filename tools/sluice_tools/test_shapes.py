"""Shapes of particles against geometry: bodies made of them have the area that they have."""
import types
import unittest
from unittest import mock

import numpy as np

from sluice_tools import shapes


def cube(count):
    """Centres [n, 3] of count^3 unit cubes around the origin."""
    lattice = np.arange(count) - 0.5 * (count - 1)
    return np.stack(np.meshgrid(lattice, lattice, lattice, indexing="ij"), -1).reshape(-1, 3)


def area(corners):
    """Areas [n] of parallelograms."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / shapes.OVERLAP ** 2


class Sections(unittest.TestCase):
    def test_a_plane_through_a_layer_meets_each_of_its_cubes_once(self):
        places = cube(5)
        met, corners = shapes.sections(places, np.broadcast_to(np.eye(3), (125, 3, 3)), 2, 0.1)
        self.assertEqual(met.sum(), 25)
        np.testing.assert_allclose(area(corners), 1)
        np.testing.assert_allclose(corners.mean(axis=1), places[met][:, :2], atol=1e-12)

    def test_a_deformed_body_is_cut_without_gaps(self):
        """Prisms of a sheared, turned, stretched lattice fill the plane: through each of their
        columns it cuts one parallelogram, and the areas are those of the columns."""
        rng = np.random.default_rng(3)
        for _ in range(20):
            deformed = np.eye(3) + 0.5 * rng.uniform(-1, 1, (3, 3))
            places = cube(9) @ deformed.T
            edges = np.broadcast_to(deformed, (len(places), 3, 3))
            position = float(rng.uniform(-0.2, 0.2))
            met, corners = shapes.sections(places, edges, 1, position)
            # By Cauchy's rule: the share of the plane that points hit is 1 within the body.
            inside = rng.uniform(-1.0, 1.0, (200, 2))
            hits = sum(in_parallelogram(inside, quad) for quad in corners)
            self.assertTrue((hits >= 1).all())
            self.assertLess(hits.mean(), shapes.OVERLAP ** 3 + 0.15)
            self.assertLess(met.sum(), 2 * 81 + 1)

    def test_turned_by_45_degrees_about_an_axis_in_the_plane(self):
        """A square prism seen along its diagonal: cut in the middle it is sqrt(2) wide."""
        c = np.sqrt(0.5)
        turned = np.array([[1, 0, 0], [0, c, -c], [0, c, c]])
        _, corners = shapes.sections(np.zeros((1, 3)), turned[None], 2, 0.0)
        np.testing.assert_allclose(area(corners), np.sqrt(2))


def in_parallelogram(points, corners):
    a, b = corners[1] - corners[0], corners[3] - corners[0]
    shares = np.linalg.solve(np.stack([a, b], axis=1), (points - corners[0]).T)
    return ((shares >= 0) & (shares <= 1)).all(axis=0).astype(int)


class Edges(unittest.TestCase):
    """Cells of 1 x 1 x 0.5 and of half of that; objects with 2 x 2 and with 1 x 4 particles."""

    def setUp(self):
        def level(size):
            return types.SimpleNamespace(spacing=(size, size, 0.5 * size),
                                         active_directions=lambda: [0, 1])
        self.step = types.SimpleNamespace(levels=[level(1.0), level(0.5)], archive=None)
        self.enterContext(mock.patch.object(shapes, "_counts",
                                            lambda *_: [[2, 2, 1], [1, 4, 1]]))

    def edges(self, **table):
        return shapes.edges(self.step, 0, {"p.x": np.zeros((1, 3)), **table})[0]

    def test_what_is_saved_as_edges_is_taken(self):
        scale = np.arange(9.0)[None]
        np.testing.assert_array_equal(self.edges(**{"p.scalefactor": scale}),
                                      scale.reshape(3, 3))

    def test_widths_are_those_of_the_deck_with_the_nearest_volume(self):
        deformed = np.array([[2.0, 0, 0, 0, 1, 0, 0, 0, 1]])
        for volume, widths in ((0.25, (1.0, 0.5, 0.5)), (0.25 / 8, (0.5, 0.25, 0.25))):
            found = self.edges(**{"p.volume": np.array([volume]), "p.deformationMeasure": deformed})
            np.testing.assert_allclose(found, np.diag(widths))

    def test_without_a_deformation_the_box_has_the_volume(self):
        found = self.edges(**{"p.volume": np.array([0.125 * 1.21])})
        np.testing.assert_allclose(found, np.diag((0.55, 0.55, 0.5)))

    def test_with_nothing_it_is_that_of_the_deck(self):
        np.testing.assert_allclose(self.edges(), np.diag((0.5, 0.5, 0.5)))


if __name__ == "__main__":
    unittest.main()
