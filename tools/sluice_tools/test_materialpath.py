"""The picture of a material's path."""
import pathlib
import tempfile
import unittest

import numpy

from sluice_tools import materialpath


class Path(unittest.TestCase):
    def test_equivalent_strain_of_a_stretch(self):
        table = {f"F_{a}{b}": numpy.full(2, float(a == b)) for a in "xyz" for b in "xyz"}
        table["F_xx"] = numpy.array([1.0, 1.5])
        strain = materialpath.equivalent_strain(table)
        self.assertAlmostEqual(strain[0], 0)
        self.assertAlmostEqual(strain[1], 2 / 3 * numpy.log(1.5))

    def test_all_six_stresses_are_drawn(self):
        time = numpy.linspace(0, 1, 5)
        table = {f"F_{a}{b}": time * 0 + (a == b) for a in "xyz" for b in "xyz"}
        for part in ("xx", "yy", "zz", "yz", "xz", "xy"):
            table[f"stress_{part}"] = 1 + time
        for name in ("time", "equivalent_stress", "energy", "temperature"):
            table[name] = time
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            materialpath.draw(table, str(picture), "all")
            self.assertGreater(picture.stat().st_size, 1000)

    def test_missing_file_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            self.assertEqual(materialpath.main([folder + "/none.csv", "-o", str(picture)]), 2)


if __name__ == "__main__":
    unittest.main()
