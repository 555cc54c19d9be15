"""Tests of the table of costs."""
import unittest

import costs


class Told(unittest.TestCase):
    def test_a_second_is_told_and_five_are_too_many(self):
        lines, over = costs.told({"A.Short": 0.9, "A.Long": 3.0, "A.Endless": 5.1}, 1.0)
        self.assertEqual([line.split()[-1] for line in lines], ["A.Endless", "A.Long"])
        self.assertEqual(over, ["A.Endless"])

    def test_a_slow_machine_is_counted(self):
        lines, over = costs.told({"A.Long": 9.0, "A.Short": 1.9}, 2.0)
        self.assertEqual((len(lines), over), (1, []))

    def test_whole_commands_have_limits_of_their_own(self):
        self.assertEqual(costs.told({"tools.scenes": 19.0}, 1.0)[1], [])
        self.assertEqual(costs.told({"tools.scenes": 21.0}, 1.0)[1], ["tools.scenes"])


if __name__ == "__main__":
    unittest.main()
