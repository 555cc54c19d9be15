"""Tests of the check of decks and of the index that is written from their heads."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_decks  # noqa: E402
from check_decks import deck_pages  # noqa: E402
from lint_tree import Tree  # noqa: E402

DECK = """<?xml version="1.0" encoding="UTF-8"?>
<!--
  Subject:    shocks
  Problem:    a tube
              with |one| shock.
  Reference:  closed form.
  Run time:   3 s (200 cells)
  Expect:     a front.
-->
<Uintah_specification/>
"""


class Decks(Tree):
    def setUp(self):
        super().setUp()
        self.write("inputs/ice/tube.ups", DECK)
        self.renew()

    def renew(self):
        self.write("inputs/ice/README.md", deck_pages.page(self.root, "ice"))

    def test_good_folder_has_a_row_for_each_deck(self):
        self.assertEqual(check_decks.check(self.root), [])
        self.assertIn("| [tube](tube.ups) | a tube with \\|one\\| shock. | closed form. | 5 s |  |",
                      (self.root / "inputs/ice/README.md").read_text())

    def test_an_index_that_is_not_up_to_date_is_a_fault(self):
        for change in [("a tube", "a box"), ("shocks", "gravity"), ("3 s", "6 s")]:
            self.write("inputs/ice/tube.ups", DECK.replace(*change))
            self.assertEqual(check_decks.check(self.root), [
                "inputs/ice/README.md: it is not what the heads of the decks say: ./dev docs"])
        (self.root / "inputs/ice/README.md").unlink()
        self.assertEqual(len(check_decks.check(self.root)), 1)

    def test_each_fault_of_a_head_is_named_with_its_deck(self):
        for old, new, said in [
                ("  Subject:    shocks\n", "", "not Subject, Problem, Reference, Run time, Expect"),
                ("  Expect:     a front.\n", "", "not Subject, Problem, Reference"),
                ("shocks", "shocks and more", "'shocks and more' is none of shocks, smooth"),
                ("3 s (200 cells)", "long", "Run time: 'long' does not begin with a number")]:
            self.write("inputs/ice/tube.ups", DECK.replace(old, new))
            faults = check_decks.check(self.root)
            self.assertEqual(len(faults), 1, faults)
            self.assertIn("inputs/ice/tube.ups: ", faults[0])
            self.assertIn(said, faults[0])

    def test_an_unknown_folder_is_a_fault(self):
        self.write("inputs/sea/tube.ups", DECK)
        self.assertIn("inputs/sea/README.md", check_decks.check(self.root)[0])

    def test_run_times_in_classes(self):
        for said, shown in [("0.05 s", "1 s"), ("1 s", "1 s"), ("1.5 s", "2 s"), ("20 s", "20 s"),
                            ("21 s", "over 20 s"), ("10 min (fine)", "over 20 s")]:
            self.assertEqual(deck_pages.time_class(said), shown)

    def test_pictures_of_gallery_and_studies(self):
        self.write("docs/gallery.md", "# Gallery\n\n## A tube\n\n`./dev run inputs/ice/tube.ups`\n")
        self.assertIn("| [picture](../../docs/gallery.md#a-tube) |",
                      deck_pages.page(self.root, "ice"))
        self.write("docs/gallery.md", "# Gallery\n")
        self.write("docs/accuracy/sod.png", "")
        self.write("regression/accuracy/sod.study",
                   '// A study.\n{"deck": "../../inputs/ice/tube.ups"}\n')
        self.assertIn("| [error](../../docs/accuracy/sod.png) |",
                      deck_pages.page(self.root, "ice"))


if __name__ == "__main__":
    unittest.main()
