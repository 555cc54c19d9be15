"""The gallery: a picture is older when its deck or its commands have changed, and not otherwise."""
import pathlib
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import gallery  # noqa: E402

PAGE = """# Gallery

```sh
sluice run inputs/a.ups \\
  --set Time/maxTime=2
sluice plot a.uda -o a.png
sluice movie a.uda -o a.gif
```

![a](pictures/a.png) ![b](pictures/a.gif)
"""
# A stand-in for the program: it writes its words into the file that it is to draw.
PROGRAM = '#!/bin/sh\nfor last; do :; done\n[ "$1" = run ] || echo "$@" > "$last"\n'


class Gallery(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("inputs", "docs/pictures"):
            (self.root / name).mkdir(parents=True)
        self.write("inputs/a.ups", "<!-- old --> <U> <x>1</x> </U>")
        self.write(gallery.PAGE, PAGE)
        self.write("sluice", PROGRAM)
        (self.root / "sluice").chmod(stat.S_IRWXU)

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def draw(self):
        known = gallery.recorded(self.root)
        return gallery.draw(self.root, str(self.root / "sluice"),
                            lambda name, now: known.get(name) != now)

    def faults(self):
        return list(gallery.faults(self.root))

    def test_what_is_not_there_is_told_and_drawn(self):
        self.assertEqual(len(self.faults()), 2)
        self.assertEqual(self.draw(), 2)
        self.assertEqual(self.faults(), [])
        self.assertEqual((self.root / "docs/pictures/a.png").read_text(),
                         "plot a.uda -o a.png\n")
        self.assertEqual(self.draw(), 0)

    def test_a_changed_deck_makes_pictures_older_and_a_comment_does_not(self):
        self.draw()
        self.write("inputs/a.ups", "<!-- new -->\n<U>\n<x>1</x></U>")
        self.assertEqual(self.faults(), [])
        self.write("inputs/a.ups", "<U><x>2</x></U>")
        self.assertEqual(len(self.faults()), 2)
        self.assertIn("a.png is older than its deck", self.faults()[0])

    def test_a_changed_command_makes_its_own_picture_older(self):
        self.draw()
        self.write(gallery.PAGE, PAGE.replace("movie a.uda", "movie a.uda --fps 5"))
        self.assertEqual([fault.split(": ")[1].split()[0] for fault in self.faults()], ["a.gif"])
        self.write(gallery.PAGE, PAGE.replace("maxTime=2", "maxTime=3"))
        self.assertEqual(len(self.faults()), 2)

    def test_what_is_drawn_is_shown(self):
        self.draw()
        self.write(gallery.PAGE, PAGE.replace("![b](pictures/a.gif)", ""))
        self.assertIn("drawn but not shown", self.faults()[0])

    def test_wrong_blocks_are_told(self):
        for old, new in (("sluice plot a.uda -o a.png", "rm a.uda"), (" -o a.png", ""),
                         ("inputs/a.ups", "inputs/b.ups")):
            self.write(gallery.PAGE, PAGE.replace(old, new))
            with self.assertRaises(gallery.GalleryError):
                self.faults()


if __name__ == "__main__":
    unittest.main()
