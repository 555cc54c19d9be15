"""Tests of the checks of names in comments and pages, of tables in pages, and of exceptions."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_comments  # noqa: E402
import check_lines  # noqa: E402
import check_pages  # noqa: E402
import check_words  # noqa: E402
import report  # noqa: E402
from lint_tree import Tree  # noqa: E402


class Comments(Tree):
    def faults(self, text, name="src/ice/a.cpp"):
        self.write("src/ice/step/runs.hpp", "// runs\n")
        self.write("docs/theory/flow.md", "# Flow\n## Shape `functions`\n")
        self.write(name, text)
        return check_comments.check(self.root)

    def test_what_exists(self):
        self.assertEqual(self.faults(
            "// runs.hpp, step/runs.hpp; ice/step/runs.hpp. (src/ice/step/runs.hpp)\n"
            "int a;  // docs/theory/flow.md, \"Shape functions\"; flow.md#shape-functions\n"
            "// NAME_command.cpp, test_*.py, run.json, sluice_version.hpp; flow.md, \"Shape\n"
            "// functions\"; Toro (2009), section 4\nconst char* t = \"gone.hpp\";\n"), [])

    def test_each_fault_with_its_line(self):
        for text, fault in [
                ("// a\n// see gone.hpp\n", "src/ice/a.cpp:2: there is no file 'gone.hpp'"),
                ("// mixture/runs.hpp\n", "src/ice/a.cpp:1: there is no file 'mixture/runs.hpp'"),
                ("int a;  // flow.md#shape\n", "src/ice/a.cpp:1: flow.md has no heading 'shape'"),
                ("/* theory/flow.md, \"Forms\" */", "src/ice/a.cpp:1: theory/flow.md has no "
                                                  "heading 'Forms'"),
                ("// mpm_scheme, section 4\n", "src/ice/a.cpp:1: there is no page 'mpm_scheme'")]:
            self.assertEqual(self.faults(text), [fault])

    def test_other_languages(self):
        self.assertEqual(len(self.faults('"""See gone.py."""\nx = 1  # lost.sh\ny = "no.py"\n',
                                         "tools/a.py")), 2)
        self.assertEqual(len(self.faults("echo gone.sh  # lost.sh\n", "tools/b.sh")), 3)


class Pages(Tree):
    def faults(self, text):
        self.write("src/ice/a.hpp", "namespace n {\nstruct A {\n  int size = 0;\n  void run();\n"
                   "  enum Kind { wet, dry };\n};\nint free_one(int);\n}\n")
        self.write("README.md", text)
        return check_pages.check(self.root)

    def test_what_exists(self):
        self.assertEqual(self.faults(
            "`src/ice/`, `src/ice/a.hpp`, `ice/a`, `A::run`, `n::A::size`, `Kind::dry`, `run()`, "
            "`std::string`, `free_one()`, `ROOM::FILE`\n```\ngone.hpp B::c\n```\ngone.hpp\n"), [])

    def test_each_fault_with_its_line(self):
        for span, fault in [
                ("src/ice/b.hpp", "there is no file 'src/ice/b.hpp'"),
                ("src/mpm/", "there is no folder or file 'src/mpm'"),
                ("A::stop", "there is no 'A::stop' in src/"),
                ("stop()", "there is no 'stop' in src/")]:
            self.assertEqual(self.faults(f"one\n`{span}`\n"), [f"README.md:2: {fault}"])

    def test_files_that_a_reader_makes(self):
        text = "**New file `src/ice/b.hpp`**\n\nIn `src/ice/b.hpp` ...\n"
        self.assertEqual(self.faults(text), [])
        self.assertEqual(self.faults("**New file `src/ice/a.hpp`**\n"),
                         ["README.md:1: 'src/ice/a.hpp' is to be a new file, and exists"])

    def test_tables_of_rooms(self):
        guide = pathlib.Path(check_pages.__file__).resolve().parents[2] / check_pages.GUIDE
        self.write(check_pages.GUIDE, guide.read_text(encoding="utf-8"))
        self.assertEqual(list(check_pages.check_rooms(self.root)), [])
        self.write(check_pages.GUIDE, guide.read_text(encoding="utf-8").replace(
            "| equations of state", "| states"))
        self.assertIn("are not those of", list(check_pages.check_rooms(self.root))[0])
        self.write(check_pages.GUIDE, "# Guide\n")
        self.assertIn("docs/developer_guide.md: there is no table of the rooms of src/ice",
                      list(check_pages.check_rooms(self.root)))


class Exceptions(unittest.TestCase):
    faults = ["src/a.cpp:3: there is no file 'x.hpp'", "src/b/c.cpp:1: there is no file 'y.hpp'"]

    def left(self, *rows):
        exceptions = [dict(zip(report.COLUMNS, row)) for row in rows]
        return report.without_exceptions("comments", self.faults, exceptions)

    def test_they_hold_for_their_check_file_and_text(self):
        self.assertEqual(self.left(("comments", "src/a.cpp", "x.hpp", "why")), self.faults[1:])
        self.assertEqual(self.left(("comments", "src/b/", "no file", "why")), self.faults[:1])
        self.assertEqual(self.left(("lines", "src/a.cpp", "x.hpp", "why")), self.faults)

    def test_one_that_nothing_needs_is_a_fault(self):
        for row in [("comments", "src/a.cpp", "z.hpp", "why"),
                    ("comments", "src/a", "x.hpp", "why")]:
            left = self.left(row)
            self.assertEqual(left[:2], self.faults)
            self.assertIn("nothing needs it", left[2])

    def test_there_are_few_and_each_has_a_reason(self):
        rows = report.read_exceptions()
        self.assertLessEqual(
            len(rows) + len(check_words.EXCEPTIONS) + len(check_lines.EXCEPTIONS), 15)
        checks = {f.stem.removeprefix("check_") for f in
                  pathlib.Path(report.__file__).parent.glob("check_*.py")}
        for row in rows:
            self.assertEqual(list(row), report.COLUMNS)
            self.assertTrue(all(row.values()), row)
            self.assertIn(row["check"], checks)


if __name__ == "__main__":
    unittest.main()
