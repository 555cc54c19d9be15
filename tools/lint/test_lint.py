"""Tests of checks of lines, functions, links and words: small trees with one known fault each."""
import pathlib
import sys
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_functions  # noqa: E402
import check_lines  # noqa: E402
import check_links  # noqa: E402
import check_words  # noqa: E402
import report  # noqa: E402
from lint_tree import Tree  # noqa: E402


class Lines(Tree):
    def faults(self, text, name="src/a.cpp"):
        return list(check_lines.faults_of(pathlib.Path(name), text))

    def test_good_file(self):
        self.assertEqual(self.faults("// Purpose.\nint a;\n"), [])

    def test_each_fault(self):
        for text, expected in [
                ("// a\n" + "x" * 101 + "\n", "101 characters"),
                ("// a\n" + "x\n" * 800, "801 lines"),
                ("// a\n\tx\n", "a tab"),
                ("// a\nx \n", "blanks at the end"),
                ("// a\n// TO" + "DO later\n", "unfinished marker"),
                ("int a;\n", "one sentence")]:
            faults = self.faults(text)
            self.assertEqual(len(faults), 1, faults)
            self.assertIn(expected, faults[0])

    def test_walks_a_tree_without_git(self):
        self.write("src/a.cpp", "int a;\n")
        self.write("src/picture.png", "int a;\n")
        self.assertEqual(len(check_lines.check(self.root)), 1)


    def test_contributing_says_the_same(self):
        text = (report.PROJECT / "CONTRIBUTING.md").read_text(encoding="utf-8")
        text = " ".join(text.split())
        for number in [f"about {check_lines.USUAL_FILE} lines, {check_lines.LONGEST_FILE} never",
                       f"lines up to {check_lines.LONGEST_LINE} characters",
                       f"functions up to {check_functions.LONGEST_FUNCTION} lines",
                       f"folders up to {check_functions.MOST_FILES} files"]:
            self.assertIn(number, text)

    def test_long_files_are_listed(self):
        self.write("src/a.cpp", "// a\n" * 401)
        self.write("src/b.cpp", "// b\n" * 500)
        self.write("src/c.cpp", "// c\n" * 400)
        self.assertEqual([(n, str(f)) for n, f in check_lines.long_files(self.root)],
                         [(500, "src/b.cpp"), (401, "src/a.cpp")])


class Functions(Tree):
    def faults(self, text, name="ice/a.cpp"):
        self.write(name, text)
        return check_functions.check(self.root)

    def test_long_functions(self):
        body = "  f();\n"
        self.assertEqual(self.faults("void f() {\n" + body * 58 + "}\n"), [])
        self.assertEqual(self.faults("// f\n\ntemplate <class T>\nvoid n::f() {\n" + body * 58 +
                                     "}\n"), [
            "src/ice/a.cpp:3: n::f: 61 lines (at most 60; a table says so above: // Table: ...)"])

    def test_tables_and_tests(self):
        long = "void f() {\n" + "  f();\n" * 70 + "}\n"
        self.assertEqual(self.faults("// All. Table: a row for each.\n" + long), [])
        self.assertEqual(len(self.faults("// Table: a row for each.\nint a;\n" + long)), 1)
        self.assertEqual(len(self.faults(long, "ice/a_test.cpp")), 1)  # the file before

    def test_folders_of_many_files(self):
        for n in range(45):
            self.write(f"ice/step/f{n}.cpp", "// f\n")
        self.write("ice/step/f_test.cpp", "// f\n")
        self.write("ice/step/test_support/t.hpp", "// t\n")
        self.assertEqual(check_functions.check(self.root), [])
        self.assertIn("src/ice/step/: 46 files of production code",
                      self.faults("// g\n", "ice/step/g.hpp")[0])


class Links(Tree):
    def test_only_missing_files_are_told(self):
        self.write("docs/a.md", "[b](b.md) [web](https://x.org)\n[up](../README.md#head)\n"
                   "[gone](c.md)\n")
        self.write("docs/b.md", "# Top\nsee [top](#top)\n")
        self.write("README.md", "![p](docs/p.png)\n# Head\n")
        self.assertEqual(check_links.check(self.root), [
            "README.md:1: 'docs/p.png' is not there", "docs/a.md:3: 'c.md' is not there"])

    def test_headings_are_looked_for(self):
        self.write("docs/a.md", "# One page\n```\n# no heading\n```\n[1](#one-page) "
                   "[2](#no-heading)\n[3](b.md#step-1-what-it-is) [4](b.md#step-1)\n[5](b.txt#1)\n")
        self.write("docs/b.md", "## Step 1: what `it` *is*\n")
        self.write("docs/b.txt", "")
        self.assertEqual(check_links.check(self.root), [
            "docs/a.md:5: '#no-heading': the page has no such heading",
            "docs/a.md:6: 'b.md#step-1': the page has no such heading"])

    def test_anchors_of_earlier_headings_are_kept(self):
        self.write("docs/a.md", '<a id="going-on"></a>\n## Restart\n[1](#going-on) [2](#restart)\n'
                   '[3](#report)\n')
        self.assertEqual(check_links.check(self.root), [
            "docs/a.md:4: '#report': the page has no such heading"])


class Words(Tree):
    def faults(self, literal):
        return list(check_words.faults_of("src/a.cpp", check_words.literals(literal)))

    def test_each_word_is_named_with_its_line_and_a_better_one(self):
        for text, word, better in [
                ("x is not built yet", "built", "supported"),
                ("boxes (usual)", "usual", "default"),
                ("one halo point", "halo point", "ghost exchange"),
                ("7 % slept", "slept", "skipped blocks"),
                ("Scenes end", "Scenes", "problem"),
                ("{:g} doubles a cell", "doubles a cell", "per cell"),
                ("peak {} a rank", "{} a rank", "per rank")]:
            told = self.faults(f'\n\nsay("{text}");')
            self.assertEqual(len(told), 1, text)
            self.assertTrue(told[0].startswith(f"src/a.cpp:3: '{word}' is no word for users"), told)
            self.assertIn(better, told[0])

    def test_a_text_in_several_literals_is_one(self):
        self.assertEqual(len(self.faults('say("a halo "\n    "point");')), 1)
        self.assertEqual(len(self.faults('say(R"(a halo point)");')), 1)

    def test_comments_includes_identifiers_and_numbers_are_passed_over(self):
        self.assertEqual(self.faults('// "a scene"\n/* "built" */\n#include "scene/scene.hpp"\n'
                                     'int built = 1\'000; char c = \'"\'; int usual = 2\'0;\n'
                                     'read_scene("half of a cell", "blocks_asleep");'), [])

    def test_pages_and_sources_are_read_and_tests_are_not(self):
        self.write("README.md", "one\n| MPM | not built |\n")
        self.write("src/a.cpp", '// a\nconst char* a = "a scene";\n')
        self.write("src/a_test.cpp", '// a\nconst char* a = "a scene";\n')
        told = check_words.check(self.root)
        self.assertEqual([line.split(" ")[0] for line in told], ["src/a.cpp:2:", "README.md:2:"])

    def test_phrases_of_prose_are_found_in_literals_and_over_line_ends(self):
        found = list(check_words.faults_of_source("src/a.cpp", 'f(\n"what is told");'))
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("src/a.cpp:2: 'is told' is no word"), found)
        found = list(check_words.faults_of_page("docs/a.md", "# A\nIt is\ntold of.\n"))
        self.assertEqual([fault.split(" ")[0] for fault in found],
                         ["docs/a.md:2:", "docs/a.md:3:"])

    def test_rooms_for_later_pass_prose_and_no_other_word(self):
        source = 'say("it has no state"); say("a halo point");'
        found = list(check_words.faults_of_source("src/mpm/step/a.cpp", source))
        self.assertEqual([("halo" in fault) for fault in found], [True])
        self.assertEqual(len(list(check_words.faults_of_source("src/mpm/a.cpp", source))), 2)

    def test_pages_that_are_not_finished_and_code_of_pages_are_passed_over(self):
        page = "It is told.\n"
        self.assertEqual(list(check_words.faults_of_page("notes.md", page)), [])
        self.assertEqual(len(list(check_words.faults_of_page("docs/theory/a.md", page))), 1)
        code = "`is told` [a](is%20told.md) $$is told$$\n```\nis told\n```\n"
        self.assertEqual(list(check_words.faults_of_page("docs/a.md", code)), [])

    def test_comments_of_finished_folders_are_read(self):
        source = "// What nobody\n// asks for.\nint a;  // is\n// told\n"
        rows = [*check_words.table(), check_words.Row("finished", "", "src/done", "", "", "")]
        with unittest.mock.patch.object(check_words, "table", lambda: rows):
            found = list(check_words.faults_of_source("src/done/a.cpp", source))
        self.assertEqual([fault.split(" ")[0] for fault in found],
                         ["src/done/a.cpp:1:", "src/done/a.cpp:3:"])
        self.assertEqual(list(check_words.faults_of_source("src/a.cpp", source)), [])

    def test_a_row_that_cannot_be_read_is_named(self):
        self.write("words.tsv", "# head\nphrase\tprose\t\ta\tb\tc\nword\ta\n")
        with self.assertRaisesRegex(ValueError, "words.tsv:3: expected a kind"):
            check_words.table(self.root / "words.tsv")

    def test_symbols_get_other_names_that_differ_in_their_class(self):
        taken = {}
        for row in check_words.table():
            if row.kind == "symbol":
                self.assertRegex(row.old, r"^[A-Za-z_]\w*$")
                self.assertRegex(row.new, r"^[A-Za-z_]\w*$")
                self.assertNotEqual(row.old, row.new)
                self.assertEqual(taken.setdefault((row.where, row.new), row.old), row.old, row)
        self.assertTrue(taken)

    def test_every_phrase_has_a_better_one_and_matches_text(self):
        for what in ("printed", "prose"):
            self.assertTrue(check_words.phrases(what))
            for pattern, better in check_words.phrases(what):
                self.assertTrue(better)
                self.assertFalse(pattern.search(""))

    def test_exceptions_hold_for_their_text_alone(self):
        path = "src/framework/base/communicator.cpp"
        text = "another MPI (built with {}.{} of the standard)"
        self.assertEqual(list(check_words.faults_of(path, [(1, text)])), [])
        self.assertEqual(len(list(check_words.faults_of(path, [(1, "built")]))), 1)

    def test_exceptions_are_still_needed(self):
        root = pathlib.Path(check_words.__file__).resolve().parents[2]
        for (path, piece), reason in check_words.EXCEPTIONS.items():
            texts = [text for _, text in check_words.literals((root / path).read_text())]
            self.assertTrue(any(piece in text for text in texts), path)
            self.assertTrue(reason)


if __name__ == "__main__":
    unittest.main()
