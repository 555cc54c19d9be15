"""Tests of the picture of residuals against time."""
import json
import pathlib
import tempfile
import unittest

from sluice_tools import residuals

RESULTS = {
    "deck": "a.ups", "title": "A hot blob", "unknowns": 8000, "curve_goal": 1e-8,
    "curves": [
        {"name": "hypre cg+pfmg, relax 2, skip 1", "of_deck": False,
         "seconds": [0.001, 0.002, 0.004], "residuals": [1.0, 1e-4, 5e-9]},
        {"name": "CGSolver", "of_deck": True,
         "seconds": [0.002, 0.004, 0.009], "residuals": [1.0, 1e-4, 5e-9]}]}


class Residuals(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.results = self.root / "tune.json"

    def write(self, results):
        self.results.write_text(json.dumps(results))
        return str(self.results)

    def test_picture_names_solvers_goal_and_units(self):
        target = self.root / "picture.svg"
        self.assertEqual(residuals.main([self.write(RESULTS), "-o", str(target)]), 0)
        text = target.read_text()
        for expected in ("CGSolver (the deck's own)", "hypre cg+pfmg", "goal of the deck", "(ms)",
                         "8,000 unknowns", "A hot blob"):
            self.assertIn(expected, text)

    def test_what_cannot_be_drawn_is_told(self):
        with self.assertRaisesRegex(residuals.ResultsError, "nothing to draw"):
            residuals.read_results(self.write({**RESULTS, "curves": []}))
        with self.assertRaisesRegex(residuals.ResultsError, "needed are"):
            residuals.read_results(self.write({"curves": [{"name": "a"}]}))
        self.assertEqual(residuals.main([str(self.root / "none.json")]), 2)


if __name__ == "__main__":
    unittest.main()
