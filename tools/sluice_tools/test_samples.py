"""Histories and samples of <DataAnalysis>, from files written as docs/analysis.md tells."""
import json
import unittest

import numpy as np

from sluice_tools import histories, plot, samples
from sluice_tools.archive import Archive, ArchiveError
from sluice_tools.test_support import Scenes

FILES = {
    "MinMax/L-0/press_CC_0": "# time[s] minimum maximum of press_CC [Pa], material 0\n"
                             "0.1 1 5\n0.2 2 6\n",
    "MinMax/L-0/vel_CC_0": "# time[s] minimum maximum of vel_CC [m/s], material 0\n"
                           "0.1 [1 2 3] [4 5 6]\n",
    "points/ahead": "# at 1 1 0\n# Timestep Time Level press_CC_0\n3 0.1 0 7\n6 0.2 1 8\n",
    "mid/t00003/L-0/press_CC_0.dat": "# Simulation time: 0.1\n# X Y Z press_CC_0\n"
                                     "0 0 0 1\n1 0 0 2\n0 1 0 3\n1 1 0 4\n",
    "mid/t00006/L-0/press_CC_0.dat": "# Simulation time: 0.2\n# X Y Z press_CC_0\n"
                                     "0 0 0 5\n1 0 0 6\n0 1 0 7\n1 1 0 8\n",
    "across/L-0/i0_j1_k0": "# X Y Z Timestep Time vel_CC_0.x vel_CC_0.y\n"
                           "0 0 0 3 0.1 1 2\n0 0 0 6 0.2 3 4\n",
    "across/L-0/i1_j1_k0": "# X Y Z Timestep Time vel_CC_0.x vel_CC_0.y\n"
                           "1 0 0 3 0.1 5 6\n1 0 0 6 0.2 7 8\n",
    "planeAverage/t00006/L-0/temp_CC_0": "# Simulation time: 0.2\n# X Y Z temp_CC_0 nCells\n"
                                         "0 0.5 0 300 8\n0 1.5 0 310 8\n",
    "square.dat": "# controlVolFluxes 'square': cells\n# mass of material 0 [kg]\n"
                  "#Time Total X_faces Y_faces Z_faces x- x+ y- y+ z- z+\n"
                  "0.1 1 2 3 4 5 6 7 8 9 10\n",
    "particleExtract/L-0/12": "# time x y z p.stress.xx\n0.1 1 2 3 9\n",
    "levels.txt": "# step\ttime\tlevel 0\n0\t0\t8\n",
}


class Written(Scenes):
    def setUp(self):
        super().setUp()
        self.tube()
        for name, text in FILES.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        self.archive = Archive(self.root)
        self.known = samples.catalogue(self.archive)


class Catalogue(Written):
    def test_every_sample_is_found_once_with_its_kind(self):
        self.assertEqual({name: sample.kind for name, sample in self.known.items()}, {
            "TotalMass": "history", "MinMax/L-0/press_CC_0": "extremes",
            "MinMax/L-0/vel_CC_0": "extremes", "points/ahead": "probe",
            "mid/L-0/press_CC_0": "plane", "across/L-0": "line",
            "planeAverage/L-0/temp_CC_0": "average", "square": "budget",
            "particleExtract/L-0/12": "particle"})

    def test_a_wrong_name_is_told(self):
        with self.assertRaisesRegex(ArchiveError, "did you mean 'points/ahead'"):
            samples.find(self.archive, "points/ahed")


class Reading(Written):
    def read(self, name, time=None):
        return samples.read(self.known[name], time)

    def test_columns_have_their_names(self):
        for name, columns in (
                ("TotalMass", ["Timestep", "Time", "value"]),
                ("MinMax/L-0/press_CC_0", ["Time", "minimum", "maximum"]),
                ("MinMax/L-0/vel_CC_0", ["Time", "minimum.x", "minimum.y", "minimum.z",
                                         "maximum.x", "maximum.y", "maximum.z"]),
                ("points/ahead", ["Timestep", "Time", "Level", "press_CC_0"]),
                ("square", ["Time", "Total", "X_faces", "Y_faces", "Z_faces", "x-", "x+", "y-",
                            "y+", "z-", "z+"]),
                ("particleExtract/L-0/12", ["time", "x", "y", "z", "p.stress.xx"])):
            table = self.read(name)
            self.assertEqual(table.columns, columns)
            self.assertEqual(table.rows.shape[1], len(columns))

    def test_vectors_of_extremes_are_taken_apart(self):
        np.testing.assert_array_equal(self.read("MinMax/L-0/vel_CC_0").rows,
                                      [[0.1, 1, 2, 3, 4, 5, 6]])

    def test_snapshots_are_chosen_by_time(self):
        self.assertEqual(self.read("mid/L-0/press_CC_0").time, 0.2)
        early = self.read("mid/L-0/press_CC_0", 0.12)
        self.assertEqual(early.time, 0.1)
        np.testing.assert_array_equal(early.column("press_CC_0"), [1, 2, 3, 4])

    def test_lines_come_by_time_and_place(self):
        np.testing.assert_array_equal(self.read("across/L-0").column("vel_CC_0.x"), [1, 5, 3, 7])

    def test_a_damaged_file_is_named(self):
        (self.root / "points/ahead").write_text("# Timestep Time Level p\n1 2 x 4\n")
        with self.assertRaisesRegex(ArchiveError, "points/ahead"):
            self.read("points/ahead")

    def test_units_are_those_of_the_labels(self):
        for name, column, unit in (("MinMax/L-0/press_CC_0", "minimum", "Pa"),
                                   ("across/L-0", "vel_CC_0.x", "m/s"), ("square", "x-", "kg/s")):
            self.assertEqual(samples.unit(self.known[name], column, self.archive), unit)


class Graphs(Written):
    def graphs(self, name, *words):
        given = plot.parse([str(self.root), "--history", name, *words])
        return histories.graphs_of(self.archive, name, given)

    def test_vectors_share_a_panel(self):
        graph, = self.graphs("across/L-0")
        self.assertEqual([curve.label for curve in graph.curves], ["x, t = 0.2 s", "y, t = 0.2 s"])
        np.testing.assert_array_equal(graph.curves[0].y, [3, 7])

    def test_several_times_of_a_line(self):
        graph, = self.graphs("across/L-0", "--time", "first", "--time", "0.2")
        np.testing.assert_array_equal([c.y for c in graph.curves[::2]], [[1, 5], [3, 7]])

    def test_a_plane_is_an_image(self):
        graph, = self.graphs("mid/L-0/press_CC_0")
        np.testing.assert_array_equal(graph.cells[3], [[5, 6], [7, 8]])

    def test_averages_go_by_the_direction_of_their_planes(self):
        graph, = self.graphs("planeAverage/L-0/temp_CC_0")
        self.assertEqual(graph.x_label, "y  (m)")
        np.testing.assert_array_equal(graph.curves[0].y, [300, 310])

    def test_effects_are_those_of_the_report_that_cost_something(self):
        with self.assertRaisesRegex(ArchiveError, "tells no effects"):
            self.graphs("effects")
        (self.root / "run.json").write_text(json.dumps({"effects": [
            {"name": "flow", "on": True, "seconds": 2.0}, {"name": "heat", "on": False, "seconds": 0},
            {"name": "drag", "on": True, "seconds": 3.0}]}))
        graph, = self.graphs("effects")
        self.assertEqual(list(graph.bars.items()), [("drag", 3.0), ("flow", 2.0)])

    def test_all_are_drawn_and_those_of_two_archives_over_each_other(self):
        words = [word for name in (*self.known, "levels") for word in ("--history", name)]
        target = self.root.parent / "x.svg"
        self.assertEqual(plot.main([str(self.root), *words, "-o", str(target)]), 0)
        self.assertEqual(plot.main([str(self.root), str(self.root), "--names", "a,b", "--history",
                                    "square", "-o", str(target)]), 0)
        self.assertIn("b, x+", target.read_text())


if __name__ == "__main__":
    unittest.main()
