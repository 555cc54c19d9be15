"""Tests of the archive reader and the pictures, on archives written here by the format's rules."""
import os
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from sluice_tools import levels, plot, views
from sluice_tools.archive import Archive, ArchiveError

SPACING = (0.25, 0.5, 1.0)


def level_xml(index, spacing, low, high, boxes, active=(1, 1, 0)):
    patches = "".join(f"<Patch><id>{n}</id><proc>0</proc><lowIndex>{list(a)}</lowIndex>"
                      f"<highIndex>{list(b)}</highIndex></Patch>" for n, (a, b) in enumerate(boxes))
    return (f"<Level><id>{index}</id><anchor>[1, 2, 0]</anchor>"
            f"<cellspacing>{list(spacing)}</cellspacing><active>{list(active)}</active>"
            f"<refinementRatio>{[2, 2, 1] if index else [1, 1, 1]}</refinementRatio>"
            f"<domainLow>{list(low)}</domainLow><domainHigh>{list(high)}</domainHigh>"
            f"{patches}</Level>")


class Writer:
    """A small archive of one step; fields are functions of position, one component a function."""

    def __init__(self, root, levels):
        self.root, self.levels = pathlib.Path(root), levels
        self.records, self.variables = [], []
        (self.root / "t00007").mkdir(parents=True)
        self.file = h5py.File(self.root / "t00007/p00000.h5", "w")

    def add(self, name, kind, functions):
        shift = {"CC": (.5, .5, .5), "SFCX": (0, .5, .5)}[kind]
        self.variables.append((name, kind, len(functions)))
        for level, (spacing, _, _, boxes, *_) in enumerate(self.levels):
            values, stored_boxes = [], []
            for low, high in boxes:
                high = (high[0] + (kind == "SFCX"), *high[1:])
                stored_boxes.append([*low, *high])
                index = np.meshgrid(*(np.arange(low[d], high[d]) for d in range(3)), indexing="ij")
                x = [(1, 2, 0)[d] + (index[d] + shift[d]) * spacing[d] for d in range(3)]
                values += [(f(*x) + 0 * x[0]).flatten(order="F") for f in functions]
            group = self.file.create_group(f"/l{level}/{name}/m0")
            group["boxes"] = np.array(stored_boxes, dtype="i4")
            group["values"] = np.concatenate(values)
            group["crc32c"] = np.zeros((len(boxes), len(functions)), dtype="u4")
            value = "Vector" if len(functions) == 3 else "double"
            self.records.append(f'<Variable type="{kind}Variable&lt;{value}&gt;" name="{name}" '
                                f'level="{level}" material="0" group="/l{level}/{name}/m0"/>')

    def add_particles(self, level, boxes):
        """Boxes of particles as rows of id, x, y, z."""
        kinds = {"p.x": ("Point", slice(1, 4)), "p.particleID": ("long64", slice(0, 1))}
        for name, (value, columns) in kinds.items():
            blocks = [np.array(box, dtype=float)[:, columns] for box in boxes]
            group = self.file.create_group(f"/l{level}/{name}/m0")
            group["boxes"] = np.array([[0, 0, 0, len(box), 1, 1] for box in boxes], dtype="i4")
            group["values"] = np.concatenate([block.flatten(order="F") for block in blocks])
            group["crc32c"] = np.zeros((len(boxes), blocks[0].shape[1]), dtype="u4")
            self.records.append(f'<Variable type="ParticleVariable&lt;{value}&gt;" name="{name}" '
                                f'level="{level}" material="0" group="/l{level}/{name}/m0"/>')
            entry = (name, "Particle", blocks[0].shape[1])
            if entry not in self.variables:
                self.variables.append(entry)

    def close(self):
        self.file.close()
        folder = self.root / "t00007"
        (folder / "p00000.xml").write_text("<Uintah_Output><Datafile href='p00000.h5'/>" +
                                           "".join(self.records) + "</Uintah_Output>")
        grid = "".join(level_xml(n, *level) for n, level in enumerate(self.levels))
        (folder / "timestep.xml").write_text(
            f"<Uintah_timestep><Grid>{grid}</Grid><Data><Datafile href='p00000.xml'/></Data>"
            "</Uintah_timestep>")
        variables = "".join(
            f'<variable type="{kind}Variable&lt;{"Vector" if n == 3 else "double"}&gt;" '
            f'name="{name}" unit="m/s" numMaterials="1"/>' for name, kind, n in self.variables)
        (self.root / "TotalMass.dat").write_text("1\t0.1\t2.5\n2\t0.2\t2.5\n")
        (self.root / "index.xml").write_text(
            "<Uintah_DataArchive><outputFormat>HDF5</outputFormat><globals><variable "
            'href="TotalMass.dat" name="TotalMass" type="double"/></globals>'
            f"<variables>{variables}</variables><timesteps>"
            '<timestep href="t00007/timestep.xml" time="0.5" oldDelt="0.1">7</timestep>'
            "</timesteps></Uintah_DataArchive>")


class OnDisk(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name) / "case.uda.000"

    def two_dimensional(self):
        """Two levels: 8 by 4 cells in two boxes, the fine one over coarse cells 2..4 by 1..3."""
        writer = Writer(self.root, [
            (SPACING, (0, 0, 0), (8, 4, 1), [((0, 0, 0), (3, 4, 1)), ((3, 0, 0), (8, 4, 1))]),
            ((0.125, 0.25, 1.0), (0, 0, 0), (16, 8, 1), [((4, 2, 0), (8, 6, 1))])])
        writer.add("press_CC", "CC", [lambda x, y, z: x + 10 * y])
        writer.add("vel_CC", "CC", [lambda x, y, z: x, lambda x, y, z: y, lambda x, y, z: 0 * z])
        writer.add("uvel_FC", "SFCX", [lambda x, y, z: x])
        writer.close()
        return Archive(self.root)

    def tube(self):
        tube = (0.1, 1.0, 1.0), (0, 0, 0), (10, 1, 1), [((0, 0, 0), (10, 1, 1))], (1, 0, 0)
        levels = [(tube[0], tube[1], tube[2], tube[3])]
        writer = Writer(self.root, levels)
        writer.add("rho_CC", "CC", [lambda x, y, z: x ** 2])
        writer.add("vel_CC", "CC", [lambda x, y, z: -x, lambda x, y, z: 0 * y,
                                    lambda x, y, z: 0 * z])
        writer.close()
        return Archive(self.root)


class Reading(OnDisk):
    def test_values_lie_where_their_coordinates_say(self):
        step = self.two_dimensional().step()
        for level in (0, 1):
            field = step.field("press_CC", level=level)
            x, y = field.coordinates(0), field.coordinates(1)
            np.testing.assert_allclose(field.values[:, :, 0], x[:, None] + 10 * y[None, :])
            faces = step.field("uvel_FC", level=level)
            np.testing.assert_allclose(faces.values[:, 0, 0], faces.coordinates(0))

    def test_pieces_are_the_boxes_as_they_are_stored(self):
        step = self.two_dimensional().step()
        self.assertEqual([key for key in step.stored() if key[2] == 1],
                         [("press_CC", 0, 1), ("uvel_FC", 0, 1), ("vel_CC", 0, 1)])
        pieces = step.pieces("press_CC", 0, 0)
        self.assertEqual([piece[:2] for piece in pieces],
                         [((0, 0, 0), (3, 4, 1)), ((3, 0, 0), (8, 4, 1))])
        whole = step.field("press_CC").values
        np.testing.assert_array_equal(np.concatenate([p[2][0] for p in pieces]), whole)
        self.assertEqual(step.pieces("press_CC", 1, 0), [])
        self.assertEqual([level.ratio for level in step.levels], [(1, 1, 1), (2, 2, 1)])

    def test_vector_components(self):
        field = self.two_dimensional().step().field("vel_CC")
        np.testing.assert_allclose(field.values[0, :, 0, 0], field.coordinates(0))
        np.testing.assert_allclose(field.values[1, 0, :, 0], field.coordinates(1))

    def test_particles_of_all_boxes_and_levels_come_by_their_ids(self):
        writer = Writer(self.root, [
            (SPACING, (0, 0, 0), (8, 4, 1), [((0, 0, 0), (8, 4, 1))]),
            ((0.125, 0.25, 1.0), (0, 0, 0), (16, 8, 1), [((4, 2, 0), (8, 6, 1))])])
        writer.add_particles(0, [[(7, 1.5, 2.5, 0), (1, 1.25, 2, 0)], [(4, 2, 3, 1)]])
        writer.add_particles(1, [[(3, 1.75, 2.75, 0)]])
        writer.close()
        step = Archive(self.root).step()
        particles = step.particles()
        np.testing.assert_array_equal(particles["p.particleID"], [1, 3, 4, 7])
        np.testing.assert_array_equal(particles["p.x"], [[1.25, 2, 0], [1.75, 2.75, 0], [2, 3, 1],
                                                         [1.5, 2.5, 0]])
        with self.assertRaisesRegex(ArchiveError, "material 1"):
            step.particles(1)
        with self.assertRaisesRegex(ArchiveError, "save p.x"):
            self.second("no_particles").step().particles()

    def second(self, name):
        self.root = self.root.parent / name
        return self.tube()

    def test_times(self):
        archive = self.two_dimensional()
        for good in ("last", "first", "#0", "0.5", "0.6"):
            self.assertEqual(archive.step(good).number, 7)
        for bad in ("#1", "9", "soon"):
            with self.assertRaises(ArchiveError):
                archive.step(bad)

    def test_unknown_name_tells_the_known_ones(self):
        with self.assertRaisesRegex(ArchiveError, "press_CC, uvel_FC, vel_CC"):
            self.two_dimensional().step().field("prss_CC")

    def test_other_formats_are_refused_by_name(self):
        self.root.mkdir()
        (self.root / "index.xml").write_text("<Uintah_DataArchive><outputFormat>PIDX</outputFormat>"
                                             "</Uintah_DataArchive>")
        with self.assertRaisesRegex(ArchiveError, "'PIDX'"):
            Archive(self.root)

    def test_history(self):
        along, places, values = self.two_dimensional().history("TotalMass")
        self.assertEqual(along, "time")
        np.testing.assert_array_equal(places, [0.1, 0.2])
        np.testing.assert_array_equal(values, [[2.5], [2.5]])


class Views(OnDisk):
    def test_line_is_sorted_and_along_the_tube(self):
        x, values, levels = views.line(self.tube().step(), "vel_CC")
        np.testing.assert_allclose(x, 1.05 + 0.1 * np.arange(10))
        np.testing.assert_allclose(values, -x)
        self.assertEqual(set(levels), {0})

    def test_covered_cells_are_those_under_the_fine_level(self):
        step = self.two_dimensional().step()
        mask = views.covered(step, 0, (8, 4, 1), (0, 0, 0))
        self.assertEqual(mask.sum(), 4)
        self.assertTrue(mask[2:4, 1:3, 0].all())

    def test_plane_edges_and_values(self):
        (xs, ys, sheet, hidden), fine = views.plane(self.two_dimensional().step(), "press_CC")
        np.testing.assert_allclose(xs, 1 + 0.25 * np.arange(9))
        np.testing.assert_allclose(ys, 2 + 0.5 * np.arange(5))
        self.assertEqual(sheet.shape, (4, 8))
        self.assertAlmostEqual(sheet[1, 0], 1.125 + 10 * 2.75)
        self.assertEqual(fine[2].shape, (4, 4))
        self.assertEqual(hidden.sum(), 4)
        self.assertTrue(hidden[1:3, 2:4].all())
        self.assertFalse(fine[3].any())


class Levels(OnDisk):
    def three(self):
        """8 by 4 cells; an L of three boxes of level 1, one box of level 2 in it."""
        writer = Writer(self.root, [
            (SPACING, (0, 0, 0), (8, 4, 1), [((0, 0, 0), (8, 4, 1))]),
            ((0.125, 0.25, 1.0), (0, 0, 0), (16, 8, 1),
             [((0, 0, 0), (4, 4, 1)), ((4, 0, 0), (8, 4, 1)), ((0, 4, 0), (4, 8, 1))]),
            ((0.0625, 0.125, 1.0), (0, 0, 0), (32, 16, 1), [((0, 0, 0), (8, 4, 1))])])
        writer.add("press_CC", "CC", [lambda x, y, z: x + 10 * y])
        writer.close()
        (self.root / "input.xml").write_text(
            "<U><AMR><Regridder><min_patch_size>[[2,4,1]]</min_patch_size></Regridder></AMR></U>")
        return Archive(self.root).step()

    def lines(self, kind):
        found = {level.index: lines for level, lines in levels.plane_lines(self.three(), kind)}
        return {level: (len(lines), np.abs(np.diff(lines, axis=1)).sum())
                for level, lines in found.items()}

    def test_boxes_are_drawn_with_all_their_edges(self):
        # A box of level 1 is 0.5 by 1, that of level 2 is 0.5 by 0.5.
        found = self.lines("boxes")
        self.assertEqual({n: count for n, (count, _) in found.items()}, {1: 12, 2: 4})
        self.assertAlmostEqual(found[1][1], 3 * 2 * (0.5 + 1.0))
        self.assertAlmostEqual(found[2][1], 2 * (0.5 + 0.5))

    def test_edges_leave_out_where_boxes_of_a_level_touch(self):
        found = self.lines("edges")
        self.assertAlmostEqual(found[1][1], 2 * (1.0 + 2.0))  # of an L: as its bounding box
        self.assertEqual(found[1][0], 6)

    def test_tiles_are_those_of_the_deck(self):
        found = self.lines("tiles")
        self.assertAlmostEqual(found[1][1], 3 * (3 * 1.0 + 2 * 0.5))  # [2,4,1]: two in each box
        self.assertAlmostEqual(found[2][1], 5 * 0.5 + 2 * 0.5)  # the last entry holds on
        self.assertEqual(self.lines_of_none(), [])

    def lines_of_none(self):
        return list(levels.plane_lines(Archive(self.root).step(), "none"))

    def test_legend_counts_boxes_cells_and_share(self):
        step = self.three()
        self.assertEqual(levels.share_text(step, step.levels[0]), "level 0: 1 box, 32 cells")
        self.assertEqual(levels.share_text(step, step.levels[1]),
                         "level 1: 3 boxes, 48 cells, 38 % of the domain")

    def test_a_line_shows_each_level_and_what_is_hidden(self):
        tube = [((0.1, 1, 1), (0, 0, 0), (10, 1, 1), [((0, 0, 0), (10, 1, 1))], (1, 0, 0)),
                ((0.05, 1, 1), (0, 0, 0), (20, 1, 1),
                 [((4, 0, 0), (8, 1, 1)), ((8, 0, 0), (10, 1, 1)), ((16, 0, 0), (18, 1, 1))],
                 (1, 0, 0))]
        writer = Writer(self.root, tube)
        writer.add("rho_CC", "CC", [lambda x, y, z: x ** 2])
        writer.close()
        step = Archive(self.root).step()
        (zero, _, _, hidden), (one, x, values, _) = views.profiles(step, "rho_CC")
        self.assertEqual((zero, one), (0, 1))
        np.testing.assert_array_equal(np.nonzero(hidden)[0], [2, 3, 4, 8])
        self.assertEqual(np.isfinite(values).sum(), 8)
        np.testing.assert_allclose(levels.bands(step, step.levels[1]), [(1.2, 1.5), (1.8, 1.9)])
        x, values, _ = views.line(step, "rho_CC")
        self.assertEqual(len(x), 6 + 8)
        np.testing.assert_allclose(values, x ** 2)

    def test_radii_take_each_place_once_from_the_finest_level(self):
        square = [((1.0, 1, 1), (0, 0, 0), (2, 2, 1), [((0, 0, 0), (2, 2, 1))], (1, 1, 0)),
                  ((0.5, 0.5, 1), (0, 0, 0), (4, 4, 1), [((0, 0, 0), (2, 2, 1))], (1, 1, 0))]
        writer = Writer(self.root, square)
        writer.add("rho_CC", "CC", [lambda x, y, z: x ** 2 + y ** 2 + 0 * z])
        writer.close()
        (zero, coarse, _), (one, fine, values) = views.radii(Archive(self.root).step(), "rho_CC")
        self.assertEqual((zero, one), (0, 1))
        self.assertEqual((len(coarse), len(fine)), (3, 4))
        np.testing.assert_allclose(values, fine ** 2)


class Pictures(OnDisk):
    def draw(self, *options, suffix=".png"):
        target = self.root.parent / ("picture" + suffix)
        status = plot.main([str(self.root), "-o", str(target), *options])
        return status, target

    def test_a_line_has_no_radius(self):
        self.tube()
        status, target = self.draw("--radius")
        self.assertEqual(status, 2)
        self.assertFalse(target.exists())

    def test_tube_with_exact_solution(self):
        self.tube()
        exact = self.root.parent / "exact.csv"
        exact.write_text("# t = 0.5\nx,rho_CC,vel_CC\n1,1,-1\n2,4,-2\n")
        status, target = self.draw("--exact", str(exact), suffix=".svg")
        self.assertEqual(status, 0)
        text = target.read_text()
        for expected in ("density", "velocity", "exact", "10 cells"):
            self.assertIn(expected, text)

    def test_plane_with_outlines_and_history(self):
        self.two_dimensional()
        self.assertEqual(self.draw("--var", "vel_CC.x", "--var", "press_CC")[0], 0)
        status, target = self.draw("--history", "TotalMass")
        self.assertEqual(status, 0)
        self.assertGreater(os.path.getsize(target), 5000)

    def test_cells_of_levels_over_time(self):
        self.two_dimensional()
        self.assertEqual(self.draw("--history", "levels")[0], 2)  # a run on one level
        (self.root / "levels.txt").write_text("# step\ttime\tlevel 0\tlevel 1\n"
                                              "0\t0\t32\t0\n3\t0.25\t32\t16\n7\t0.5\t32\t16\n")
        np.testing.assert_array_equal(Archive(self.root).level_cells()[:, 3], [0, 16, 16])
        status, target = self.draw("--history", "levels", "--history", "TotalMass", suffix=".svg")
        self.assertEqual(status, 0)
        self.assertIn("cells of each level", target.read_text())

    def test_levels_have_a_legend_unless_unwanted(self):
        self.two_dimensional()
        for kind, told in (("boxes", True), ("tiles", True), ("edges", True), ("none", False)):
            status, target = self.draw("--var", "press_CC", "--levels", kind, suffix=".svg")
            self.assertEqual(status, 0)
            self.assertEqual("level 1: 1 box, 16 cells, 12 % of the domain" in target.read_text(),
                             told, kind)

    def test_faults_are_bad_input(self):
        self.tube()
        self.assertEqual(self.draw("--var", "nosuch")[0], 2)
        self.assertEqual(self.draw("--exact", "nosuch.csv")[0], 2)
        self.assertEqual(plot.main([str(self.root.parent / "nosuch.uda")]), 2)
        for option in (["--slice", "q=1"], ["--levels", "some"], ["-o", "picture.doc"]):
            with self.assertRaises(SystemExit) as ended:
                plot.main([str(self.root), *option])
            self.assertEqual(ended.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
