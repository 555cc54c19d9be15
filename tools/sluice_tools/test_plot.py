"""What pictures say of what they draw."""
import types
import unittest

from sluice_tools import plot


class Step:
    def __init__(self, materials):
        self._materials = materials

    def materials(self, name):
        return self._materials[name]


class MaterialText(unittest.TestCase):
    def text(self, there, given=None, name="rho_CC"):
        return plot.material_text(Step({"rho_CC": there, "vel_CC": there}), name,
                                  types.SimpleNamespace(material=given))

    def test_one_material_is_not_named(self):
        self.assertEqual(self.text([0]), "")
        self.assertEqual(self.text([1], 1), "")

    def test_of_several_the_drawn_one_is(self):
        self.assertEqual(self.text([0, 1]), ", material 0")
        self.assertEqual(self.text([1, 2]), ", material 1")
        self.assertEqual(self.text([0, 1, 2], 2), ", material 2")
        self.assertEqual(self.text([0, 1], 1, "vel_CC.x"), ", material 1")


if __name__ == "__main__":
    unittest.main()
