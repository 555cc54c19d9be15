"""Tests of the source checks: small trees with one known fault each."""
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_layers  # noqa: E402
import check_lines  # noqa: E402
import check_links  # noqa: E402
import check_words  # noqa: E402


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


class Layers(Tree):
    def test_downward_is_allowed(self):
        self.write("framework/base/a.hpp", "// a\n")
        self.write("ice/b.cpp", '// b\n#include "framework/base/a.hpp"\n#include <vector>\n')
        self.assertEqual(check_layers.check(self.root), [])

    def test_upward_is_named_with_its_line(self):
        self.write("ice/b.hpp", "// b\n")
        self.write("framework/base/a.cpp", '// a\n#include "ice/b.hpp"\n')
        faults = check_layers.check(self.root)
        self.assertEqual(len(faults), 1)
        self.assertIn("framework/base/a.cpp:2: framework/base may not include ice", faults[0])

    def test_ice_and_mpm_do_not_know_each_other(self):
        self.write("mpm/m.hpp", "// m\n")
        self.write("ice/b.cpp", '// b\n#include "mpm/m.hpp"\n')
        self.assertEqual(len(check_layers.check(self.root)), 1)

    def test_floors_of_a_house(self):
        self.write("ice/fluid/f.hpp", "// f\n")
        self.write("ice/mixture/m.hpp", '// m\n#include "ice/fluid/f.hpp"\n')
        self.write("ice/fluid/g.cpp", '// g\n#include "ice/mixture/m.hpp"\n')
        self.write("ice/ice.hpp", "// top\n")
        self.write("ice/mixture/n.cpp", '// n\n#include "ice/ice.hpp"\n')
        faults = check_layers.check(self.root)
        self.assertEqual(len(faults), 2)
        self.assertIn("ice/fluid/g.cpp:2: ice/fluid may not include ice/mixture", faults[0])
        self.assertIn("ice/mixture/n.cpp:2: ice/mixture may not include ice (", faults[1])

    def test_rooms_of_one_floor_do_not_know_each_other(self):
        self.write("ice/levels/l.hpp", "// l\n")
        self.write("ice/account/a.cpp", '// a\n#include "ice/levels/l.hpp"\n')
        self.assertEqual(len(check_layers.check(self.root)), 1)

    def test_tests_may_use_their_house_and_test_support(self):
        self.write("ice/ice.hpp", "// top\n")
        self.write("ice/test_support/s.hpp", '// s\n#include "ice/ice.hpp"\n')
        self.write("ice/fluid/f_test.cpp", '// f\n#include "ice/test_support/s.hpp"\n')
        self.assertEqual(check_layers.check(self.root), [])
        self.write("ice/fluid/f.cpp", '// f\n#include "ice/test_support/s.hpp"\n')
        self.assertEqual(len(check_layers.check(self.root)), 1)

    def test_unknown_room_of_a_house(self):
        self.write("ice/attic/a.cpp", "// a\n")
        self.assertIn("'ice/attic' is no room", check_layers.check(self.root)[0])

    def test_circle_of_headers(self):
        self.write("ice/a.hpp", '// a\n#include "ice/b.hpp"\n')
        self.write("ice/b.hpp", '// b\n#include "ice/a.hpp"\n')
        faults = check_layers.check(self.root)
        self.assertEqual(faults, ["circle: ice/a.hpp -> ice/b.hpp -> ice/a.hpp"])

    def test_include_must_be_given_from_src(self):
        self.write("ice/b.hpp", "// b\n")
        self.write("ice/a.cpp", '// a\n#include "b.hpp"\n')
        self.assertIn('write "ice/b.hpp"', check_layers.check(self.root)[0])

    def test_unknown_room(self):
        self.write("misc/a.cpp", "// a\n")
        self.assertIn("no room of the design", check_layers.check(self.root)[0])


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
