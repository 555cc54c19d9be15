"""What programs of users get from an archive."""
import types
import sys
import unittest
from unittest import mock

import numpy as np

import sluice_tools
from sluice_tools import to_yt
from sluice_tools.archive import ArchiveError
from sluice_tools.test_support import RADIUS, Scenes


class Runs(Scenes):
    def test_outputs_materials_and_labels(self):
        self.bubble(particles=True)
        run = sluice_tools.open(self.root)
        self.assertEqual((len(run), run.times, run.title), (1, [0.5], "A bubble"))
        self.assertEqual(run.materials, {0: "steel", 1: "helium", 2: "air"})
        self.assertEqual(run.labels["press_CC"], "m/s")
        self.assertEqual([out.number for out in run], [7])
        self.assertEqual(run[-1].labels["rho_CC"], ["helium", "air"])
        self.assertEqual(run.at(0.5).time, 0.5)
        with self.assertRaises(IndexError):
            run[1]
        with self.assertRaisesRegex(ArchiveError, "did you mean 'helium'"):
            run["last"].field("rho_CC", "heliun")

    def test_fields_are_those_of_a_material_and_of_the_whole(self):
        self.bubble()
        out = sluice_tools.open(self.root)["last"]
        inside = out.field("vol_frac_CC", "helium").values > 0
        np.testing.assert_array_equal(out.field("rho_CC", "air").values, np.where(inside, 0, 1.2))
        np.testing.assert_allclose(out.scalar("rho_CC").values, np.where(inside, 0.2, 1.2))
        self.assertTrue(np.isnan(out.scalar("rho_CC", "air").values[inside]).all())

    def test_particles_come_with_tensors_as_matrices(self):
        self.bubble(particles=True)
        table = sluice_tools.open(self.root)["last"].particles("steel")
        self.assertEqual(table["p.stress"].shape[1:], (3, 3))
        np.testing.assert_allclose(table["p.stress"][:, 1, 1], 1e6 * table["p.x"][:, 0])
        x0, x1, y0, y1 = self.SQUARE
        self.assertAlmostEqual(table["p.volume"].sum(), (x1 - x0) * (y1 - y0) * 0.1)
        few = sluice_tools.open(self.root)["last"].particles("steel", ["p.x"])
        self.assertEqual(set(few), {"p.x", "p.particleID"})

    def test_samples_lines_and_series(self):
        self.bubble()
        run = sluice_tools.open(self.root)
        points = [[1.1, 3.0, 0.05], [2.5, 3.0, 0.05], [9.0, 3.0, 0.05]]
        np.testing.assert_allclose(run[0].sample("temp_CC", points), [400, 300, np.nan])
        np.testing.assert_allclose(run[0].sample("temp_CC", points, "air"),
                                   [np.nan, 300, np.nan])
        s, rho = run[0].line("rho_CC", (1, 3, 0.05), (3, 3, 0.05))
        np.testing.assert_allclose(rho, np.where(s < RADIUS, 0.2, 1.2))
        times, values = run.series("vel_CC", points[:2])
        self.assertEqual((times.shape, values.shape), ((1,), (1, 2, 3)))
        np.testing.assert_allclose(values[0], [[5, 0, 0], [1, 0, 0]])

    def test_histories_and_probes(self):
        self.tube()
        (self.root / "points").mkdir()
        (self.root / "points/ahead").write_text("# at 1 1 0\n# Timestep Time Level p_0\n3 .1 0 7\n")
        run = sluice_tools.open(self.root)
        self.assertEqual(run.samples, {"TotalMass": "history", "points/ahead": "probe"})
        np.testing.assert_array_equal(run.history("TotalMass")["value"], [2.5, 2.5])
        np.testing.assert_array_equal(run.probe("ahead")["p_0"], [7])


class CoveringGrids(Scenes):
    def test_each_level_has_its_own_values_and_those_of_coarser_cells_elsewhere(self):
        self.two_dimensional()
        out = sluice_tools.open(self.root)[0]
        (x, y, _), fine = out.covering_grid("press_CC", level=1)
        self.assertEqual(fine.shape, (16, 8, 1))
        inside = ((x > 1.5) & (x < 2.0))[:, None] & ((y > 2.5) & (y < 3.5))[None]
        exact = x[:, None] + 10 * y[None]
        np.testing.assert_allclose(fine[..., 0][inside], exact[inside])
        # Elsewhere the centre of the coarse cell: 0.0625 and 0.125 away along x and y.
        away = fine[..., 0][~inside] - exact[~inside]
        np.testing.assert_allclose(sorted(set(np.round(np.abs(away), 9))), [1.1875, 1.3125])
        (x, _, _), coarse = out.covering_grid("press_CC")
        self.assertEqual(coarse.shape, (8, 4, 1))
        with self.assertRaisesRegex(ArchiveError, "no level 2"):
            out.covering_grid("press_CC", 2)


class Yt(Scenes):
    def test_without_yt_it_says_what_it_needs(self):
        self.tube()
        with mock.patch.dict(sys.modules, {"yt": None}):
            with self.assertRaisesRegex(ArchiveError, "pip install 'yt>=4.1'"):
                sluice_tools.open(self.root)[0].to_yt()

    def test_yt_gets_all_boxes_of_all_levels(self):
        self.two_dimensional()
        given = {}

        def load(grids, dimensions, **options):
            given.update(options, grids=grids, dimensions=dimensions)
            return "a data set"
        with mock.patch.dict(sys.modules, {"yt": types.SimpleNamespace(load_amr_grids=load)}):
            self.assertEqual(sluice_tools.open(self.root)[0].to_yt(), "a data set")
        self.assertEqual((given["dimensions"], given["refine_by"]), ([8, 4, 1], [2, 2, 1]))
        np.testing.assert_array_equal(given["bbox"], [[1, 3], [2, 4], [0, 1]])
        self.assertEqual([grid["level"] for grid in given["grids"]], [0, 0, 1])
        for grid in given["grids"]:
            values, unit = grid["sluice", "press_CC"]
            self.assertEqual((list(values.shape), unit), (grid["dimensions"], "m/s"))
            size = (np.array(grid["right_edge"]) - grid["left_edge"]) / grid["dimensions"]
            first = np.array(grid["left_edge"]) + 0.5 * size
            self.assertAlmostEqual(values[0, 0, 0], first[0] + 10 * first[1])
            self.assertIn(("sluice", "vel_CC.y"), grid)

    def test_names_tell_the_material_where_there_are_several(self):
        self.bubble()
        grid, = to_yt.grids_of(sluice_tools.open(self.root)[0], ["rho_CC"])
        self.assertEqual({key[1] for key in grid if isinstance(key, tuple)},
                         {"rho_CC.helium", "rho_CC.air"})
        with self.assertRaisesRegex(ArchiveError, "no label of cells 'rho'"):
            to_yt.grids_of(sluice_tools.open(self.root)[0], ["rho"])

    def test_units_are_written_as_yt_does(self):
        for text, other in (("kg/m^3", "kg/m**3"), ("1", ""), ("kg m/s", "kg*m/s")):
            self.assertEqual(to_yt._unit(text), other)  # pylint: disable=protected-access

    def test_yt_itself_finds_the_values(self):
        try:
            import yt
        except ImportError:
            self.skipTest("yt is not installed: pip install 'yt>=4.1'")
        yt.set_log_level(50)
        self.two_dimensional()
        data = sluice_tools.open(self.root)[0].to_yt(["press_CC"])
        found = data.all_data()["sluice", "press_CC"]
        fine = 4 * 4  # cells of the finer level, in place of 2 x 2 coarse ones
        self.assertEqual(len(found), 32 - 4 + fine)
        self.assertAlmostEqual(float(found.max()), 2.875 + 37.5)


if __name__ == "__main__":
    unittest.main()
