"""The picture of a material's path."""
import pathlib
import tempfile
import unittest

import numpy

from sluice_tools import materialpath


class Path(unittest.TestCase):
    def test_equivalent_strain_of_a_stretch(self):
        table = {f"F_{a}{b}": numpy.array([1.0 if a == b else 0.0] * 2) for a in "xyz" for b in "xyz"}
        table["F_xx"] = numpy.array([1.0, 1.5])
        strain = materialpath.equivalent_strain(table)
        self.assertAlmostEqual(strain[0], 0)
        self.assertAlmostEqual(strain[1], 2 / 3 * numpy.log(1.5))

    def test_missing_file_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            self.assertEqual(materialpath.main([folder + "/none.csv", "-o", str(picture)]), 2)


if __name__ == "__main__":
    unittest.main()
