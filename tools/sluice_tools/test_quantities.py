"""What is drawn of materials and of the whole, against sums by hand."""
import unittest

import numpy as np

from sluice_tools import quantities, sampling, scalars, scales, views
from sluice_tools.test_archive import SPACING, Writer
from sluice_tools.archive import Archive, ArchiveError
from sluice_tools.test_support import Scenes, in_bubble


class Wholes(Scenes):
    def mixture(self):
        """Two materials everywhere: 1 kg/m^3 at 2 m/s and 300 K, 3 kg/m^3 at 6 m/s and 400 K."""
        writer = Writer(self.root, [(SPACING, (0, 0, 0), (8, 4, 1), [((0, 0, 0), (8, 4, 1))])])
        for m, (rho, u, t) in enumerate(((1.0, 2.0, 300.0), (3.0, 6.0, 400.0))):
            writer.add("rho_CC", "CC", [lambda x, y, z, v=rho: v + 0 * x], m)
            writer.add("temp_CC", "CC", [lambda x, y, z, v=t: v + 0 * x], m)
            writer.add("vel_CC", "CC", [lambda x, y, z, v=u: v + 0 * x,
                                        lambda x, y, z: 0 * x, lambda x, y, z: 0 * x], m)
        writer.add("press_CC", "CC", [lambda x, y, z: 7 + 0 * x])
        writer.close()
        return Archive(self.root).step()

    def test_means_are_over_mass(self):
        step = self.mixture()
        for name, value in (("rho_CC", 4.0), ("vel_CC.x", (2 + 18) / 4), ("vel_CC", 5.0),
                            ("temp_CC", (300 + 1200) / 4), ("press_CC", 7.0)):
            np.testing.assert_allclose(quantities.level_field(step, name).values, value)

    def test_of_one_material_its_own(self):
        np.testing.assert_allclose(quantities.level_field(self.mixture(), "vel_CC", 1).values, 6)

    def test_where_a_material_is_not_it_has_no_value(self):
        step = self.bubble().step()
        helium = quantities.level_field(step, "temp_CC", 1)
        x, y = helium.coordinates(0), helium.coordinates(1)
        inside = in_bubble(x[:, None], y[None, :])
        np.testing.assert_array_equal(np.isfinite(helium.values[:, :, 0]), inside)
        whole = quantities.level_field(step, "temp_CC").values[:, :, 0]
        np.testing.assert_allclose(whole, np.where(inside, 400.0, 300.0))

    def test_a_label_of_the_cell_belongs_to_every_material(self):
        self.assertTrue(quantities.is_of_whole(self.bubble().step(), "press_CC"))
        with self.assertRaisesRegex(ArchiveError, "not stored for material 0"):
            quantities.require(self.bubble_again(), "temp_CC", 0)

    def bubble_again(self):
        return Archive(self.root).step()


class Gradients(unittest.TestCase):
    def test_of_a_linear_function_it_is_exact_also_beside_what_is_absent(self):
        x, y = np.meshgrid(np.arange(6.0), np.arange(5.0), indexing="ij")
        values = (3 * x + 8 * y)[:, :, None]
        values[3, 2, 0] = np.nan
        size = quantities.gradient_size(values, (1.0, 2.0, 1.0), [0, 1])
        self.assertTrue(np.isnan(size[3, 2, 0]))
        known = np.isfinite(values)
        np.testing.assert_allclose(size[known], 5.0)


class RoundOff(Scenes):
    def test_equal_to_round_off_is_one_colour(self):
        for numbers, size in (([1.0, 1.0 + 1e-12], 0), ([-1e-14, 2e-14], 1.0), ([0.0, 0.0], 0)):
            low, high, colours = scalars.colour_range(np.array(numbers), size)
            self.assertEqual(colours, "cividis")
            self.assertGreater(high - low, 1e6 * np.ptp(numbers))

    def test_a_component_is_measured_by_its_vector(self):
        step = self.bubble().step()
        self.assertEqual(scales.natural_size(step, "vel_CC.y"), 5.0)

    def test_values_of_both_signs_are_drawn_around_zero(self):
        self.assertEqual(scalars.colour_range(np.array([-1.0, 3.0])), (-3.0, 3.0, "PuOr"))


class Points(Scenes):
    def test_a_point_has_the_value_of_its_cell_on_the_finest_level(self):
        step = self.two_dimensional().step()
        x = np.array([[1.3, 2.1, 0.5], [1.6, 2.6, 0.5], [3.0, 4.0, 0.5], [9.0, 2.0, 0.5]])
        values, levels = sampling.sample_scalar(step, "press_CC", x)
        np.testing.assert_array_equal(levels, [0, 1, 0, -1])
        # Centres: 0.25 x 0.5 from (1, 2) on level 0, half of that on level 1.
        np.testing.assert_allclose(values[:3], [1.375 + 22.5, 1.5625 + 26.25 + 0.0,
                                                2.875 + 37.5], atol=0.13)
        self.assertTrue(np.isnan(values[3]))

    def test_a_line_meets_each_cell_once(self):
        step = self.tube().step()
        s, values, _ = sampling.along_line(step, "rho_CC", (1, 0.5, 0.5), (2, 0.5, 0.5))
        np.testing.assert_allclose(s, 0.05 + 0.1 * np.arange(10))
        np.testing.assert_allclose(values, (1.05 + 0.1 * np.arange(10)) ** 2)

    def test_an_oblique_line_has_the_length_of_its_ends(self):
        step = self.two_dimensional().step()
        s, values, levels = sampling.along_line(step, "press_CC", (1, 2, 0.5), (3, 4, 0.5))
        self.assertLess(s[0], 0.2)
        self.assertGreater(s[-1], np.sqrt(8) - 0.2)
        self.assertEqual(set(levels), {0, 1})
        self.assertTrue(np.isfinite(values).all())

    def test_outside_is_told(self):
        with self.assertRaisesRegex(ArchiveError, "no point of it lies in the domain"):
            sampling.along_line(self.tube().step(), "rho_CC", (5, 0, 0), (6, 0, 0))

    def test_vectors_have_all_components(self):
        values = sampling.sample(self.two_dimensional().step(), "vel_CC", [[1.1, 2.2, 0.5]])
        np.testing.assert_allclose(values, [[1.125, 2.25, 0]])


class Composed(Scenes):
    def test_levels_become_one_sheet_on_the_finest_cells(self):
        step = self.two_dimensional().step()
        x, y, values = views.composed(views.plane(step, "press_CC"))
        self.assertEqual(values.shape, (8, 16))
        fine = (x > 1.5) & (x < 2.0), (y > 2.5) & (y < 3.5)
        part = values[np.ix_(fine[1], fine[0])]
        np.testing.assert_allclose(part, x[fine[0]][None] + 10 * y[fine[1]][:, None])
        self.assertTrue(np.isfinite(values).all())


if __name__ == "__main__":
    unittest.main()
