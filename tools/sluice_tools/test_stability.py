"""The map of hard cases: every verdict is drawn, the page tells failures, bad maps are refused."""
import json
import pathlib
import tempfile
import unittest

from sluice_tools import stability, style


def run(verdict, sweep=None, value=None, message="", counts=True):
    told = {"verdict": verdict, "message": message, "command": "sluice run deck.ups", "steps": 10,
            "redone": 0, "counts": counts,
            "checks": [{"must_hold": "energy", "held": verdict != "red", "found": 0.5,
                        "place": ""}]}
    if sweep:
        told.update(sweep=sweep, value=value)
    return told


def one_map():
    sweep = {"name": "multiplier", "default": "0.4", "values": ["0.2", "0.4", "0.8", "1.2"],
             "margin": 2.0, "never_failed_above": False}
    case = {"name": "block", "title": "Block <moves>", "why": "Few particles.", "source": "theory",
            "component": "solids", "must_hold": ["energy grows at most 0.01"], "sweeps": [sweep],
            "runs": [run("green"), run("amber", "multiplier", "0.2"),
                     run("green", "multiplier", "0.8"),
                     run("red", "multiplier", "1.2", "energy: found 7 at cell [1, 2, 0]", False)]}
    plain = {"name": "atube", "title": "Tube", "why": "", "source": "", "component": "fluid",
             "must_hold": ["p"], "sweeps": [], "runs": [run("red", message="no end")]}
    return {"program": "sluice", "date": "2026", "defaults_held": 1, "points": 4,
            "points_held": 2, "cases": [case, plain]}


class StabilityMap(unittest.TestCase):
    def test_every_value_is_a_field_and_the_default_stands_in_its_sweep(self):
        told = one_map()
        fields, heads = stability.fields_of(told["cases"][0])
        self.assertEqual([f[1] for f in fields], ["0.2", "0.4", "0.8", "1.2"])
        self.assertEqual([f[2]["verdict"] for f in fields], ["amber", "green", "green", "red"])
        self.assertEqual([f[3] for f in fields], [False, True, False, False])
        self.assertEqual(heads, [(0.0, "multiplier (2×)")])
        with style.pyplot() as plt:
            axes = stability.draw(told, plt).axes[0]
            self.assertEqual(len(axes.patches), 5)
            texts = [t.get_text() for t in axes.texts]
        self.assertIn("1.2 ×", texts)
        self.assertIn("0.2 –", texts)

    def test_the_page_tells_what_failed_and_how_to_repeat_it(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "m.json").write_text(json.dumps(one_map()), encoding="utf-8")
            status = stability.main([str(folder / "m.json"), "-o", str(folder / "m.png"),
                                     "--page", str(folder / "m.html")])
            self.assertEqual(status, 0)
            page = (folder / "m.html").read_text(encoding="utf-8")
        self.assertIn("energy: found 7 at cell [1, 2, 0]", page)
        self.assertIn("sluice run deck.ups", page)
        self.assertIn("Block &lt;moves&gt;", page)
        self.assertIn("1 of 2 defaults hold", page)

    def test_what_is_no_map_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "m.json"
            for text in ("{", "{}", '{"cases": [{"runs": []}]}'):
                bad.write_text(text, encoding="utf-8")
                self.assertEqual(stability.main([str(bad), "-o", str(bad) + ".png"]), 2)


if __name__ == "__main__":
    unittest.main()
