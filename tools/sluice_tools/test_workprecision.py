"""Tests of the work-precision picture."""
import json
import pathlib
import tempfile
import unittest

from sluice_tools import workprecision

CSV = """# study: sod
setting,cells,seconds,error,status,default
order 1,100,0.01,2e-2,done,0
order 1,200,0.04,1.2e-2,done,0
order 1,400,0.16,7e-3,done,0
order 2,100,0.02,8e-3,done,1
order 2,200,0.08,3e-3,done,1
order 2,400,0.3,1.5e-3,done,1
"order 2, CFL 0.9",100,0.01,7e-3,done,0
"order 2, CFL 0.9",200,0.03,,failed,0
"""


class WorkPrecision(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.csv = self.root / "sod.csv"
        self.csv.write_text(CSV)

    def test_front_is_beaten_by_nobody(self):
        rows = workprecision.read_rows(self.csv)
        front = workprecision.pareto_front(rows)
        for mine in front:
            for other in rows:
                if other["done"] and other is not mine:
                    self.assertFalse(other["seconds"] <= mine["seconds"] and
                                     other["error"] <= mine["error"])
        self.assertEqual([r["error"] for r in front], [7e-3, 3e-3, 1.5e-3])

    def test_csv_and_json_say_the_same(self):
        rows = workprecision.read_rows(self.csv)
        file = self.root / "sod.json"
        file.write_text(json.dumps({"rows": [dict(r, status="done" if r["done"] else "failed",
                                                  error=r["error"] if r["done"] else None)
                                             for r in rows]}))
        again = workprecision.read_rows(file)
        self.assertEqual([r["seconds"] for r in again], [r["seconds"] for r in rows])
        self.assertEqual([r["done"] for r in again], [r["done"] for r in rows])

    def test_picture_names_settings_default_and_failure(self):
        target = self.root / "picture.svg"
        self.assertEqual(workprecision.main([str(self.csv), "-o", str(target)]), 0)
        text = target.read_text()
        for expected in ("order 1", "order 2 (default)", "failed", "best for its time", ">400<"):
            self.assertIn(expected, text)

    def test_legend_has_as_many_columns_as_fit(self):
        self.assertEqual(workprecision.legend_columns(["order 1", "order 2"]), 2)
        self.assertEqual(workprecision.legend_columns(["order 1"] * 9), 3)
        self.assertEqual(workprecision.legend_columns(["order 2, CFL 0.9, 2 levels"] * 9), 3)
        long = ["order 2, CFL 0.9, levels 2, tiles 9"] * 3
        self.assertEqual(workprecision.legend_columns(long), 2)
        self.assertEqual(workprecision.legend_columns(["x" * 80, "y"]), 1)

    def test_points_that_lie_on_one_another_are_noted_once(self):
        with self.csv.open("a") as file:
            file.write("order 2 again,400,0.301,1.5e-3,done,0\n")
        target = self.root / "picture.svg"
        self.assertEqual(workprecision.main([str(self.csv), "-o", str(target)]), 0)
        self.assertEqual(target.read_text().count(">400<"), 2)  # of order 1 and order 2

    def many(self):
        """Ten settings, of which the last is best, one diverges and one fails."""
        rows = ["setting,cells,nx,ny,nz,seconds,error,status,default"]
        for number in range(10):
            for step, cells in enumerate((10, 20)):
                error = 1 / (number + 1) / 2 ** step
                if number == 1:
                    error *= 4 ** step
                done = "failed" if number == 2 and step else "done"
                rows.append(f"s{number},{cells},{cells},{cells},1,{0.1 * 8 ** step},{error},{done},"
                            f"{int(number == 1)}")
        file = self.root / "many.csv"
        file.write_text("# the error of the reference is below 0.06, relative 0.1\n"
                        + "\n".join(rows) + "\n")
        return file

    def test_at_most_six_lines_the_rest_is_counted(self):
        rows, reference = workprecision.read_results(self.many())
        self.assertEqual(reference, 0.06)
        drawn = workprecision.drawn_settings(rows)
        self.assertEqual(drawn, ["s1", "s9"])  # the default; the best, alone on the front
        few = [r for r in rows if r["setting"] in ("s0", "s1", "s2", "s3")]
        self.assertEqual(len(workprecision.drawn_settings(few)), 4)
        target = self.root / "picture.svg"
        self.assertEqual(workprecision.main([str(self.many()), "-o", str(target)]), 0)
        text = target.read_text()
        for expected in ("8 other settings", "s1 (default): divergence", "order 1", "order 2",
                         "error of the reference", "#cc0000"):
            self.assertIn(expected, text)

    def test_divergence_is_growth_on_the_finest_grid(self):
        rows = workprecision.read_rows(self.many())
        lines = workprecision.by_setting(rows)
        self.assertTrue(workprecision.diverges(lines["s1"]))
        self.assertFalse(workprecision.diverges(lines["s0"]))
        self.assertFalse(workprecision.diverges(lines["s2"]))  # one run alone is left

    def test_missing_column_is_bad_input(self):
        self.csv.write_text("setting,seconds\na,1\n")
        self.assertEqual(workprecision.main([str(self.csv)]), 2)
        self.assertEqual(workprecision.main([str(self.root / "nosuch.csv")]), 2)


if __name__ == "__main__":
    unittest.main()
