"""Tests of how ./dev verify pages compares a page with what was found."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from suite_decks import says_the_same  # noqa: E402

PAGE = """# Decks

3 of 4 decks are accepted, 2 run.

| a.ups | ice | accepted; runs |
| b.ups | mpm | accepted; runs |
| c.ups | ice | accepted; not finished in 150 s |
| d.ups | ice | missing: <x> |
"""


class Pages(unittest.TestCase):
    def test_a_faster_machine_finishes_more(self):
        faster = PAGE.replace("2 run", "3 run").replace("not finished in 150 s", "runs")
        self.assertTrue(says_the_same(PAGE, faster))
        self.assertTrue(says_the_same(faster, PAGE))

    def test_any_other_row_counts(self):
        for old, new in (("b.ups | mpm | accepted; runs", "b.ups | mpm | accepted; fails"),
                         ("<x>", "<y>"), ("d.ups", "e.ups")):
            self.assertFalse(says_the_same(PAGE, PAGE.replace(old, new)), new)


if __name__ == "__main__":
    unittest.main()
