"""Tests of the check of thresholds: small trees with one known fault each."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_thresholds  # noqa: E402
from check_thresholds import threshold_page  # noqa: E402
from lint_tree import Tree  # noqa: E402

GOOD = """// Rules of traces.
namespace sluice::ice {
// What is said before belongs to no form.
// threshold: volume fraction below which nothing | passes, and
//   goes on; unit: 1; test: Traces.Stay
constexpr double tiny = 1e-14;
}
"""


class Thresholds(Tree):
    def setUp(self):
        super().setUp()
        self.write("src/ice/mixture/traces_test.cpp",
                   "// t\nTEST(Traces, Stay) { constexpr double allowed = 1e-10; }\n")

    def faults(self, text, allowed=frozenset(), name="src/ice/mixture/traces.hpp"):
        self.write(name, text)
        self.write(threshold_page.PAGE, threshold_page.page(self.root))
        return check_thresholds.check(self.root, set(allowed))

    def only_fault(self, text, said, **more):
        faults = self.faults(text, **more)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(said, faults[0])

    def test_good_file_is_on_the_page(self):
        self.assertEqual(self.faults(GOOD), [])
        self.assertIn(
            "| `tiny` | `1e-14` | 1 | volume fraction below which nothing \\| passes, and goes on "
            "| `Traces.Stay` | [traces.hpp](../src/ice/mixture/traces.hpp) |",
            (self.root / threshold_page.PAGE).read_text())

    def test_a_constant_without_its_comment_is_named_with_its_line(self):
        self.only_fault("// Rules.\nconstexpr double tiny = 1e-14;  // of a cell\n",
                        "src/ice/mixture/traces.hpp:2: tiny: its comment above is not")
        for old, new in [("; unit: 1", ""), ("; test: Traces.Stay", ""), ("threshold:", "bound:"),
                         ("threshold:", "coefficient:")]:
            self.only_fault(GOOD.replace(old, new), "traces.hpp:6: tiny: its comment above is not")

    def test_a_coefficient_has_no_test(self):
        text = GOOD.replace("threshold:", "coefficient:").replace("; test: Traces.Stay", "")
        self.assertEqual(self.faults(text), [])
        self.assertIn("## Coefficients of ice/mixture",
                      (self.root / threshold_page.PAGE).read_text())

    def test_members_and_constants_of_functions_too(self):
        self.only_fault("// R.\nstruct S {\n  static constexpr double least = 0.5;\n};\n",
                        ":3: least")
        self.only_fault("// R.\nconstexpr double light = 1.0;\n", ":2: light")
        self.only_fault("// R.\nconstexpr double shares[] = {1.0, 0.5};\n", ":2: shares")

    def test_what_is_made_of_other_constants_is_passed_over(self):
        self.assertEqual(self.faults(GOOD.replace(
            "e-14;\n", "e-14;\nconstexpr double rest = 1.0 - tiny, most = limits<double>::max();\n"
        )), [])

    def test_two_in_one_declaration(self):
        faults = self.faults(GOOD.replace("e-14;", "e-14, small = 1e-13;"))
        self.assertEqual(len(faults), 2, faults)
        self.assertIn("one declaration for each number", faults[0])

    def test_the_test_exists(self):
        self.only_fault(GOOD.replace("Traces.Stay", "Traces.Leave"), "there is no test 'Traces.Lea")
        self.write("regression/bad.rows", "")
        self.assertEqual(self.faults(GOOD.replace("Traces.Stay", "bad.rows")), [])

    def test_none_needs_a_line_and_a_line_needs_one(self):
        without, line = GOOD.replace("Traces.Stay", "none"), "src/ice/mixture/traces.hpp: tiny"
        self.only_fault(without, "a threshold needs a test")
        self.assertEqual(self.faults(without, {line}), [])
        self.only_fault(GOOD, "no such threshold is without a test", allowed={line})

    def test_a_second_definition(self):
        self.write("src/ice/closure/traces.hpp", GOOD)
        self.only_fault(GOOD, "tiny = 1e-14 is defined in src/ice/closure/traces.hpp:6 too")

    def test_numbers_with_an_exponent_are_named(self):
        self.only_fault("// R.\nbool f(double x) { return x < 1e-12; }\n",
                        "traces.hpp:2: 1e-12: a number to be named")
        self.assertEqual(self.faults('// R: 1e-12.\nstruct S {\n  double tolerance = 1e-8;\n};\n'
                                     'auto t = tag("K", "1e5").real().at_most(1e20);\n'), [])

    def test_a_page_that_is_not_up_to_date(self):
        self.assertEqual(self.faults(GOOD), [])
        self.write("src/ice/mixture/traces.hpp", GOOD.replace("1e-14", "1e-13"))
        self.assertEqual(check_thresholds.check(self.root, set()), [
            "docs/thresholds.md: it is not what the comments of src/ice say: ./dev docs"])


if __name__ == "__main__":
    unittest.main()
