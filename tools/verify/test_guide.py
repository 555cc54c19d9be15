"""Tests of the reader of docs/adding.md: what it does, and what it refuses."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import guide  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = """# Page
## First
Words.

**New file `src/new.hpp`**

```cpp
int a;
```

**In `src/old.cpp`, after `two`**

```cpp
  after
```

**In `src/old.cpp`, `three` becomes `3`**

**In `src/old.cpp`, without the line `one`**

## Second

**At the end of `src/old.cpp`**

```text
end
```

```sh
true
false # exit 1
```
"""


class Guide(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        (self.root / "src").mkdir()
        (self.root / "src/old.cpp").write_text("one\ntwo\nthree\n", encoding="utf-8")

    def test_edits_and_commands(self):
        edits, commands = guide.read(PAGE)
        guide.apply(edits, self.root)
        self.assertEqual((self.root / "src/new.hpp").read_text(encoding="utf-8"), "int a;\n")
        self.assertEqual((self.root / "src/old.cpp").read_text(encoding="utf-8"),
                         "two\n  after\n3\nend\n")
        self.assertEqual([(c.text, c.status, c.line, c.section) for c in commands],
                         [("true", 0, 30, "Second"), ("false", 1, 31, "Second")])
        self.assertEqual(guide.sizes(edits), {"First": (2, 1, 4), "Second": (1, 0, 1)})

    def test_what_is_refused(self):
        for old, new, fault in [
                ("after `two`", "after `four`", "0 lines with 'four'"),
                ("after `two`", "after `t`", "2 lines with 't'"),
                ("`three` becomes", "`four` becomes", "has 0 times 'four'"),
                ("src/new.hpp", "src/old.cpp", "exists already"),
                ("**At the end of `src/old.cpp`**", "**At the end of `src/lost.cpp`**", "no file"),
                (", after `two`", ", beneath `two`", "none of the forms"),
                ("**At the end of `src/old.cpp`**\n", "", ""),
                ("```text\nend\n```\n", "", "do not follow each other")]:
            with self.assertRaises(guide.GuideError if fault else AssertionError) as told:
                edits, _ = guide.read(PAGE.replace(old, new))
                guide.apply(edits, self.root)
                self.assertEqual(len(edits), 5)
            self.assertIn(fault, str(told.exception))
            (self.root / "src/new.hpp").unlink(missing_ok=True)
            (self.root / "src/old.cpp").write_text("one\ntwo\nthree\n", encoding="utf-8")

    def test_a_block_of_code_without_a_place(self):
        with self.assertRaises(guide.GuideError):
            guide.read("```cpp\nint a;\n```\n")

    # The whole page is followed by ./dev verify adding; here its edits find their places.
    def test_the_page_fits_the_sources(self):
        page = (ROOT / "docs/adding.md").read_text(encoding="utf-8")
        edits, commands = guide.read(page)
        for edit in edits:
            file = self.root / edit.path
            if edit.kind != "new" and not file.is_file():
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes((ROOT / edit.path).read_bytes())
            elif edit.kind == "new":
                self.assertFalse((ROOT / edit.path).exists(), edit.path)
        guide.apply(edits, self.root)
        self.assertTrue(commands)
        for section, (files, new, lines) in guide.sizes(edits).items():
            self.assertRegex(page, rf"\| \[{section}\].*\| {files} \({new}\) \| {lines} \|")


if __name__ == "__main__":
    unittest.main()
