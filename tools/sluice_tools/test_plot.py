"""What pictures say of what they draw."""
import types
import unittest
import unittest.mock

import numpy as np

from sluice_tools import plot, shots


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
    def text(self, there, material=None, name="rho_CC", directions=(0, 1)):
        stored = dict.fromkeys(("rho_CC", "vel_CC", "press_CC", "sp_vol_CC"), there)
        shot = types.SimpleNamespace(step=Step(stored, directions), material=material,
                                     is_line=len(directions) == 1, archive=None)
        with unittest.mock.patch.object(plot.materials, "name", lambda _, m: "abc"[m]):
            return plot.material_text(shot, name)

    def test_what_belongs_to_the_cell_names_no_material(self):
        self.assertEqual(self.text([0, 1], name="press_CC"), "")

    def test_the_whole_names_no_material(self):
        self.assertEqual(self.text([0, 1]), "")
        self.assertEqual(self.text([0, 1], None, "vel_CC.x"), "")

    def test_one_material_is_named_where_it_is_asked_for(self):
        self.assertEqual(self.text([0]), "")
        self.assertEqual(self.text([1], 1), ", b")

    def test_of_several_the_drawn_one_is(self):
        self.assertEqual(self.text([1, 2], None, "sp_vol_CC"), ", b")
        self.assertEqual(self.text([0, 1, 2], 2), ", c")
        self.assertEqual(self.text([0, 1], 1, "vel_CC.x"), ", b")
        self.assertEqual(self.text([0, 1], None, directions=(0,)), "")  # all are drawn


class Levels(unittest.TestCase):
    def test_where_levels_begin_and_end_is_the_default(self):
        self.assertEqual(plot.parse(["some.uda"]).levels, "edges")
        self.assertEqual(plot.parse(["some.uda", "--levels", "boxes"]).levels, "boxes")


class UsualVariables(unittest.TestCase):
    def names(self, **centrings):
        variables = {name: types.SimpleNamespace(centring=c) for name, c in centrings.items()}
        return plot.usual_variables(types.SimpleNamespace(
            has=variables.__contains__, materials=lambda name: [0], names=lambda: list(variables),
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
    VALUES = {("rho_CC", 0): [1.0, 0.5, np.nan], ("rho_CC", 1): [np.nan, 2.0, 4.0],
              ("sp_vol_CC", 0): [5.0, 5.0, 6.0], ("sp_vol_CC", 1): [5.0, 5.0, 6.0]}

    def shown(self, name, material=None):
        def profiles(_, label, m):
            yield 0, np.arange(3.0), np.array(self.VALUES[label, m or 0]), np.zeros(3, bool)
        step = Step({label: [0, 1] for label in ("rho_CC", "sp_vol_CC", "press_CC")}, (0,))
        with unittest.mock.patch.object(shots.views, "profiles", profiles):
            return shots.line_materials(step, name, material)

    def test_each_is_drawn_where_it_is(self):
        self.assertEqual(self.shown("rho_CC"), [0, 1])

    def test_what_all_share_is_drawn_once(self):
        self.assertEqual(self.shown("sp_vol_CC"), [0])
        self.assertEqual(self.shown("press_CC"), [None])

    def test_the_one_asked_for_is_drawn_alone(self):
        self.assertEqual(self.shown("rho_CC", 1), [1])


if __name__ == "__main__":
    unittest.main()
