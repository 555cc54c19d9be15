"""What pictures say of what they draw."""
import types
import unittest
import unittest.mock

import numpy as np

from sluice_tools import plot


class Level:
    def __init__(self, directions):
        self._directions = directions

    def active_directions(self):
        return self._directions


class Step:
    def __init__(self, materials, directions=(0, 1)):
        self._materials = materials
        self.levels = [Level(directions)]

    def has(self, name):
        return name in self._materials

    def materials(self, name):
        return self._materials[name]


class MaterialText(unittest.TestCase):
    def text(self, there, given=None, name="rho_CC", directions=(0, 1)):
        stored = dict.fromkeys(("rho_CC", "vel_CC", "press_CC"), there)
        return plot.material_text(Step(stored, directions), name,
                                  types.SimpleNamespace(material=given, radius=False))

    def test_what_belongs_to_the_cell_names_no_material(self):
        self.assertEqual(self.text([0, 1], name="press_CC"), "")

    def test_one_material_is_not_named(self):
        self.assertEqual(self.text([0]), "")
        self.assertEqual(self.text([1], 1), "")

    def test_of_several_the_drawn_one_is(self):
        self.assertEqual(self.text([0, 1]), ", material 0")
        self.assertEqual(self.text([1, 2]), ", material 1")
        self.assertEqual(self.text([0, 1, 2], 2), ", material 2")
        self.assertEqual(self.text([0, 1], 1, "vel_CC.x"), ", material 1")
        self.assertEqual(self.text([0, 1], None, directions=(0,)), "")  # all are drawn


class Levels(unittest.TestCase):
    def test_where_levels_begin_and_end_is_the_default(self):
        self.assertEqual(plot.parse(["some.uda"]).levels, "edges")
        self.assertEqual(plot.parse(["some.uda", "--levels", "boxes"]).levels, "boxes")


class UsualVariables(unittest.TestCase):
    def names(self, **centrings):
        variables = {name: types.SimpleNamespace(centring=c) for name, c in centrings.items()}
        return plot.usual_variables(types.SimpleNamespace(
            has=variables.__contains__, names=lambda: list(variables),
            archive=types.SimpleNamespace(variables=variables)))

    def test_a_fluid_shows_its_own(self):
        self.assertEqual(self.names(phi="node", rho_CC="cell"), ["rho_CC"])

    def test_else_what_is_in_cells_and_on_nodes(self):
        self.assertEqual(self.names(phi="node", pi="cell", flux="x face"), ["phi", "pi"])

    def test_nothing_to_draw_is_told(self):
        with self.assertRaises(plot.ArchiveError):
            self.names(flux="x face")


class LinesOfMaterials(unittest.TestCase):
    """Two materials that meet in the second of three cells."""
    VALUES = {("rho_CC", 0): [1.0, 0.5, 0.0], ("rho_CC", 1): [0.0, 2.0, 4.0],
              ("temp_CC", 0): [300.0, 310.0, 0.0], ("temp_CC", 1): [0.0, 310.0, 320.0],
              ("press_CC", 0): [5.0, 5.0, 6.0], ("press_CC", 1): [5.0, 5.0, 6.0]}

    def lines(self, name, material=None):
        def profiles(_, label, m):
            x = np.arange(3.0)
            yield 0, x, np.array(self.VALUES[label, m or 0]), np.zeros(3, bool)
        step = Step({label: [0, 1] for label, _ in self.VALUES}, (0,))
        with unittest.mock.patch.object(plot.views, "profiles", profiles):
            return plot.profiles_of_materials(step, name, material)

    def test_each_is_drawn_where_it_is(self):
        lines = self.lines("temp_CC")
        self.assertEqual([m for m, _ in lines], [0, 1])
        np.testing.assert_array_equal(lines[0][1][0][2], [300.0, 310.0, np.nan])
        np.testing.assert_array_equal(lines[1][1][0][2], [np.nan, 310.0, 320.0])

    def test_what_all_share_is_drawn_once(self):
        self.assertEqual([m for m, _ in self.lines("press_CC")], [None])

    def test_the_one_asked_for_is_drawn_as_it_is_stored(self):
        lines = self.lines("temp_CC", 1)
        self.assertEqual(len(lines), 1)
        np.testing.assert_array_equal(lines[0][1][0][2], [0.0, 310.0, 320.0])


if __name__ == "__main__":
    unittest.main()
