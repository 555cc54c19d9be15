"""Tests of the page of accuracy studies: costs between grids, orders, reasons."""
import pathlib
import tempfile
import unittest

import accuracy_page as page

HEADER = ("setting,default,cells,nx,ny,nz,steps,error,l1,l2,linf,relative_l1,order,seconds,wall_s,"
          "spread,repeats,pareto,status\n")


def row(setting, default, cells, error, seconds, status="done"):
    number = "" if status != "done" else error
    return (f"{setting},{default},{cells},{cells},1,1,7,{number},{number},,,{number},,{seconds},"
            f"{seconds},0,3,0,{status}\n")


class AccuracyPage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "regression/accuracy").mkdir(parents=True)
        (self.root / "docs/accuracy").mkdir(parents=True)

    def study(self, name, rows, more=""):
        (self.root / f"regression/accuracy/{name}.study").write_text(
            f'// comment\n{{"title": "The {name}", "component": "fluid", "variable": "rho_CC"'
            f'{more}}}\n')
        (self.root / f"docs/accuracy/{name}.csv").write_text(
            "# the error of the reference is below 1e-5, relative 1e-5\n" + HEADER + "".join(rows))

    def text(self):
        page.write_page(self.root, 3)
        return (self.root / "docs/accuracy.md").read_text()

    def test_costs_follow_a_power_law_between_grids(self):
        self.study("wave", [row("a", 1, 10, 0.04, 1), row("a", 1, 20, 0.01, 4),
                            row("a", 1, 40, 0.0025, 16)])
        runs = page.read_rows(self.root / "docs/accuracy/wave.csv")
        self.assertEqual(page.cost(runs, 0.05), (1, True))
        seconds, coarsest = page.cost(runs, 0.005)
        self.assertAlmostEqual(seconds, 8, 9)  # error N^-2, time N^2
        self.assertFalse(coarsest)
        self.assertIsNone(page.cost(runs, 0.001))
        self.assertEqual(page.order_of(runs), "2.00")

    def test_the_table_names_the_best_and_says_why_the_default_is_slow(self):
        self.study("tube", [row("old", 1, 10, 0.03, 1), row("old", 1, 20, 0.009, 9),
                            row("new", 0, 10, 0.02, 1), row("new", 0, 20, 0.005, 3)],
                   ', "default_is_slower_because": "It is old."')
        text = self.text()
        self.assertIn("| [The tube](#the-tube) | fluid | 1.74 | 7.43 s · 1.73 s | – | – | new |",
                      text)
        self.assertIn("- **The tube**: the default takes up to 4.3 times as long (new). It is old.",
                      text)
        self.assertIn("## Fluid, explicit steps\n\n### The tube", text)

    def test_bars_are_counted(self):
        self.study("tube", [row("a", 1, 10, 0.03, 1), row("a", 1, 20, 0.009, 9)])
        self.study("wave", [row("a", 1, 10, 0.03, 1), row("a", 1, 20, 0.009, 9)])
        (self.root / "docs/accuracy/bars.csv").write_text(
            "study,quantity,error,bar,ratio,target,reached,refused\n"
            "tube,rho_CC,0.01,0.03,3,0.02,0.01,\n"
            "wave,rho_CC,0.01,0.08,8,0.02,,nothing covers it\n")
        text = self.text()
        self.assertIn("2 of 2 bars cover the true\nerror, 1 are at most five times", text)
        self.assertIn("of 1 runs", text)
        self.assertIn("| [The tube](#the-tube) | `rho_CC` | 3 | 0.5 |", text)
        self.assertIn("| [The wave](#the-wave) | `rho_CC` | 8 | refused |", text)

    def test_divergence_and_failures_are_called_so(self):
        self.study("bad", [row("a", 1, 10, 0.1, 1), row("a", 1, 20, 0.2, 4)])
        self.study("worse", [row("a", 1, 10, 0.1, 1), row("a", 1, 20, 0, 4, "failed")])
        self.study("round", [row("a", 1, 10, 1e-17, 1), row("a", 1, 20, 3e-17, 4)])
        text = self.text()
        self.assertIn("| [The bad](#the-bad) | fluid | diverges |", text)
        self.assertIn("| [The worse](#the-worse) | fluid | fails at some |", text)
        self.assertIn("| 20 | 7 | failed | | | |", text)
        self.assertIn("| [The round](#the-round) | fluid | exact |", text)

    def test_every_study_says_its_component(self):
        (self.root / "regression/accuracy/x.study").write_text('{"title": "X"}')
        with self.assertRaises(SystemExit):
            page.studies_of(self.root)


if __name__ == "__main__":
    unittest.main()
