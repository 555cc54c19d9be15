"""Numbers of particles, their windows, outlines and paths, against what is known of them."""
import types
import unittest

import numpy as np

from sluice_tools import particles, scalars
from sluice_tools.archive import ArchiveError


class Names(unittest.TestCase):
    def test_labels_of_solids_keep_their_dot(self):
        self.assertEqual(scalars.split_name("vel_CC.x"), ("vel_CC", "x"))
        self.assertEqual(scalars.split_name("p.x"), ("p.x", None))
        self.assertEqual(scalars.split_name("p.velocity.x"), ("p.velocity", "x"))
        self.assertEqual(scalars.split_name("g.stressFS.xy"), ("g.stressFS", "xy"))
        self.assertEqual(scalars.split_name("p.stress.vonMises"), ("p.stress", "vonMises"))

    def test_a_wrong_component_is_told(self):
        for name in ("vel_CC.w", "p.stress.xw", "p.velocity.x.y"):
            with self.assertRaises(ArchiveError):
                scalars.split_name(name)


class Tensors(unittest.TestCase):
    """Uniaxial tension S: von Mises S, pressure -S/3. Pure shear T: von Mises sqrt(3) T."""
    STRESS = np.array([[7., 0, 0, 0, 0, 0, 0, 0, 0], [0, 2., 0, 2., 0, 0, 0, 0, 0]]).T

    def scalar(self, component=None, base="p.stress"):
        return scalars.scalar(base, self.STRESS, component)

    def test_stresses_are_drawn_by_von_mises(self):
        np.testing.assert_allclose(self.scalar(), [7, np.sqrt(3) * 2])
        np.testing.assert_allclose(self.scalar("pressure"), [-7 / 3, 0])
        np.testing.assert_allclose(self.scalar("xy"), [0, 2])

    def test_deformation_gradients_by_their_determinant(self):
        turned = np.array([[0., -2, 0, 3, 0, 0, 0, 0, 1]]).T
        np.testing.assert_allclose(scalars.scalar("p.deformationMeasure", turned, None), [6])
        np.testing.assert_allclose(scalars.scalar("p.velGrad", turned, None), [np.sqrt(14)])

    def test_a_turned_stress_has_the_same_invariants(self):
        rng = np.random.default_rng(1)
        q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        s = rng.normal(size=(3, 3))
        s = s + s.T
        both = np.array([s.ravel(), (q @ s @ q.T).ravel()]).T
        for which in ("vonMises", "pressure", "det", "size"):
            a, b = scalars.scalar("p.stress", both, which)
            self.assertAlmostEqual(a, b, 12)

    def test_a_tensor_has_no_component_x(self):
        with self.assertRaises(ArchiveError):
            self.scalar("x")
        with self.assertRaises(ArchiveError):
            scalars.scalar("p.mass", np.zeros(2), "x")


def plane(low=(0, 0), high=(10, 10)):
    return types.SimpleNamespace(
        anchor=(0., 0., 0.), spacing=(1., 1., 0.5), lower=(*low, 0), upper=(*high, 1),
        active_directions=lambda: [0, 1])


def squares(places, width):
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    return places[:, None] + 0.5 * width * signs


class Outlines(unittest.TestCase):
    def test_the_line_runs_around_the_body(self):
        """A square of side 2: the picture is 1 inside, 0 outside; its area is that of the body."""
        lattice = (np.arange(20) + 0.5) * 0.1
        places = np.array([(x, y) for x in lattice for y in lattice])
        x, y, image = particles.covered_picture(squares(places, 0.1))
        inside = (np.abs(x - 1) < 0.9)[None, :] & (np.abs(y - 1) < 0.9)[:, None]
        outside = (np.abs(x - 1) > 1.12)[None, :] | (np.abs(y - 1) > 1.12)[:, None]
        self.assertTrue((image[inside] > 0.99).all())
        self.assertTrue((image[outside] < 0.5).all())
        area = (image > 0.5).sum() * (x[1] - x[0]) * (y[1] - y[0])
        self.assertAlmostEqual(area, 4, delta=0.12)

    def test_gaps_narrower_than_a_particle_are_closed_and_wider_ones_are_not(self):
        lattice = (np.arange(20) + 0.5) * 0.1
        for gap, closed in ((0.03, True), (0.3, False)):
            places = np.array([(x + (gap if x > 1 else 0), y) for x in lattice for y in lattice])
            x, _, image = particles.covered_picture(squares(places, 0.1))
            middle = image[image.shape[0] // 2]
            lowest = middle[(x > 0.9) & (x < 1.1 + gap)].min()
            self.assertEqual(lowest > 0.5, closed, gap)


class Paths(unittest.TestCase):
    """Three particles move one cell an output through a periodic side; the second appears late."""

    def setUp(self):
        def step(n):
            ids = np.array([1., 2, 3] if n > 0 else [1., 3])
            x = (ids + 6 + n) % 10
            table = {"p.particleID": ids, "p.x": np.stack([x, ids, 0 * ids], axis=1)}
            return types.SimpleNamespace(number=n, levels=[plane()],
                                         particles=lambda material, wanted: table)
        self.archive = types.SimpleNamespace(steps=[(n, float(n), None) for n in range(3)],
                                             step=lambda which: step(int(which[1:])))
        self.step = step(2)

    def test_they_follow_ids_and_break_at_periodic_sides(self):
        shot = types.SimpleNamespace(normal=None, position=None, archive=self.archive,
                                     step=self.step)
        lines = particles.paths(shot, 0, 3)
        np.testing.assert_array_equal(lines[0], [[7, 1], [8, 1], [9, 1]])
        np.testing.assert_array_equal(lines[1], [[np.nan, np.nan], [9, 2], [np.nan, np.nan]])
        np.testing.assert_array_equal(lines[2, 0], [9, 3])
        self.assertEqual(particles.paths(shot, 0, 2).shape, (2, 3, 2))


if __name__ == "__main__":
    unittest.main()
