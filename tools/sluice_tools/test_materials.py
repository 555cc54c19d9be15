"""Names and numbers of materials, from decks written here."""
import types
import unittest
import xml.etree.ElementTree as ElementTree
from unittest import mock

from sluice_tools import materials
from sluice_tools.archive import ArchiveError

DECK = """<U><MaterialProperties>
  <ICE><material name="air"/><material name="Water"/></ICE>
  <MPM><material name="steel"/><material/></MPM>
</MaterialProperties></U>"""


class Names(unittest.TestCase):
    def setUp(self):
        deck = ElementTree.fromstring(DECK)
        self.enterContext(mock.patch.object(materials, "_decks", lambda archive: [deck]))
        self.archive = types.SimpleNamespace(
            variables={"press_CC": types.SimpleNamespace(materials=5)})

    def test_solids_come_first_and_those_without_a_name_are_numbered(self):
        self.assertEqual(materials.names(self.archive),
                         {0: "steel", 1: "material 1", 2: "air", 3: "Water", 4: "material 4"})

    def test_a_material_is_given_by_name_or_number(self):
        for text, number in (("air", 2), ("water", 3), ("3", 3), (1, 1), ("material 1", 1)):
            self.assertEqual(materials.number(self.archive, text), number)

    def test_a_wrong_name_is_told_with_the_nearest(self):
        with self.assertRaisesRegex(ArchiveError, "did you mean 'steel'.*2: air"):
            materials.number(self.archive, "stell")


if __name__ == "__main__":
    unittest.main()
