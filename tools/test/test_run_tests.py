"""Tests of the runner: verdicts of cases, crashes, hangs, selection, and what a change reaches."""
import contextlib
import io
import os
import pathlib
import stat
import sys
import tempfile
import unittest
from unittest import mock

import changed
import run_tests
import suites
import work

# Speaks as a googletest executable does; cases do what their names say.
SPEAKER = """#!{python} -B
import os, signal, sys, time
cases = {cases!r}
words = " ".join(sys.argv[1:])
if "--gtest_list_tests" in words:
    print("Suite.")
    print("\\n".join("  " + c + "  # GetParam() = 4" for c in cases))
    sys.exit({list_status})
flags = dict(l.split("=", 1) for l in open(words.split("=", 1)[1]).read().split("\\n") if l)
failed = []
for name in flags["--gtest_filter"].split(":"):
    print("[ RUN      ] " + name, flush=True)
    print("words of " + name, flush=True)
    if "Dies" in name: os.kill(os.getpid(), signal.SIGSEGV)
    if "Leaves" in name: sys.exit(0)
    if "Hangs" in name: time.sleep(60)
    bad = "Fails" in name
    failed += [name] if bad or "Liar" in name else []
    end = "[  FAILED  ] " if bad else "[  SKIPPED ] " if "Skips" in name else "[       OK ] "
    print(end + name + (", where GetParam() = 4" if bad else "") + " (12 ms)", flush=True)
group = ['{{"name": "%s", "failures": [{{"failure": "told in the report"}}]}}'
         % f.split(".")[1] for f in failed]
open(flags["--gtest_output"][5:], "w").write(
    '{{"testsuites": [{{"name": "Suite", "testsuite": [%s]}}]}}' % ",".join(group))
print("[  FAILED  ] " + " ".join(failed))
sys.exit({status} or bool(failed))
"""


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scratch").mkdir()

    def script(self, name, text):
        file = self.folder / name
        file.write_text(text)
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        return str(file)

    def speaker(self, *cases, status=0, list_status=0, timeout=30.0, name="speaker_test"):
        command = self.script(name, SPEAKER.format(python=sys.executable, cases=list(cases),
                                                   status=status, list_status=list_status))
        return suites.Suite(name, [command], {"cases"}, timeout=timeout, folder=str(self.folder))

    def run_all(self, *words, of):
        """Status, printed text of run_tests over suites."""
        told = io.StringIO()
        with mock.patch.object(suites, "registered", lambda build: list(of)), \
                contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            status = run_tests.main([*words, "-j", "2", "--build", str(self.folder)])
        return status, told.getvalue()

    def test_every_case_is_counted_and_the_count_is_the_last_line(self):
        status, told = self.run_all(of=[self.speaker("One", "Two", "Skips", "DISABLED_Three")])
        self.assertEqual(status, 0)
        self.assertEqual(told.splitlines()[-1], "2 passed, 0 failed")
        self.assertIn("1 skipped", told)

    def test_a_failure_is_shown_with_name_and_output_and_hides_nothing(self):
        status, told = self.run_all(of=[self.speaker("One", "Fails", "Two")])
        self.assertEqual(status, 1)
        self.assertIn("FAILED Suite.Fails", told)
        self.assertIn("words of Suite.Fails", told)
        self.assertNotIn("words of Suite.Two", told)
        self.assertEqual(told.splitlines()[-1], "2 passed, 1 failed")

    def test_a_crash_names_its_case_and_the_others_run(self):
        for case, words in (("Dies", "SIGSEGV"), ("Leaves", "exit status 0")):
            status, told = self.run_all(of=[self.speaker("One", case, "Two", "Fails")])
            self.assertEqual(status, 1)
            self.assertIn(f"FAILED Suite.{case} ", told)
            self.assertIn(words, told)
            self.assertEqual(told.splitlines()[-1], "2 passed, 2 failed")

    def test_a_hang_is_ended_and_named_and_the_others_run(self):
        def overdue(w):  # whatever the load
            return w.open_case == "Suite.Hangs"
        with mock.patch.object(work.Work, "overdue", overdue):
            status, told = self.run_all(of=[self.speaker("One", "Hangs", "Two", timeout=0.5)])
        self.assertEqual(status, 1)
        self.assertIn("FAILED Suite.Hangs", told)
        self.assertIn("stopped after 0.5 s", told)
        self.assertEqual(told.splitlines()[-1], "2 passed, 1 failed")

    def test_a_process_that_fails_after_its_cases_fails(self):
        status, told = self.run_all(of=[self.speaker("One", status=3)])
        self.assertEqual(status, 1)
        self.assertIn("exit status 3 after the last case", told)

    def test_the_report_has_the_last_word(self):
        status, told = self.run_all(of=[self.speaker("One", "Liar")])
        self.assertEqual((status, told.splitlines()[-1]), (1, "1 passed, 1 failed"))

    def test_an_executable_that_cannot_start_or_list_fails(self):
        for suite in (self.speaker("One", list_status=3),
                      suites.Suite("gone", [str(self.folder / "gone")], {"cases"}),
                      suites.Suite("unbuilt", [], {"cases"}),
                      suites.Suite("lint.gone", [str(self.folder / "gone")], {"lint"})):
            status, told = self.run_all(of=[suite])
            self.assertEqual(status, 1, told)
            self.assertEqual(told.splitlines()[-1], "0 passed, 1 failed")

    def test_commands_pass_fail_skip_and_hang(self):
        of = [suites.Suite("good", ["true"], {"lint"}),
              suites.Suite("bad", ["sh", "-c", "echo its words; exit 4"], set()),
              suites.Suite("away", ["sh", "-c", "exit 77"], set(), skip_status=77),
              suites.Suite("slow", ["sleep", "60"], set(), timeout=0.3, slots=2)]
        status, told = self.run_all(of=of)
        self.assertEqual((status, told.splitlines()[-1]), (1, "1 passed, 2 failed"))
        self.assertIn("its words", told)
        self.assertIn("stopped after 0.3 s", told)

    def test_selection_by_name_and_label(self):
        of = [self.speaker("One", "Two"), suites.Suite("lint.lines", ["true"], {"lint"})]
        for words, count in ((["-R", "One"], 1), (["speaker_test"], 2), (["Two", "One"], 2),
                             (["-L", "lint"], 1), (["-LE", "lint"], 2), (["-E", "Two"], 2),
                             ([], 3)):
            status, told = self.run_all(*words, of=of)
            self.assertEqual((status, told.splitlines()[-1]), (0, f"{count} passed, 0 failed"))
        status, told = self.run_all("Twp", of=of)
        self.assertEqual(status, 2)
        self.assertIn("no test matches 'Twp' (nearest: Suite.Two)", told)

    def test_full_products_are_left_out_unless_asked_for(self):
        choice = suites.Selection()
        self.assertTrue(choice.takes("Kinds/FullWeighting.Of/sod"))
        self.assertFalse(choice.takes("Full/SameBits.Of/sod"))
        self.assertFalse(choice.takes("FullStudy.Converges"))
        self.assertFalse(choice.takes("Of/Pulse.FullThousandSteps/2"))
        self.assertTrue(choice.takes("Pulse.FullnessIs"))
        self.assertTrue(choice.takes("Of/Pulse.IsFullOf/Full"))
        self.assertTrue(suites.Selection(full="also").takes("Full/SameBits.Of/sod"))
        self.assertFalse(suites.Selection(full="only").takes("Fullness.Is"))
        self.assertTrue(suites.Selection(full="only").takes("FullStudy.Converges"))

    def test_long_suites_are_cut_into_parts_that_hold_each_case_once(self):
        suite = suites.Suite("s", ["s"], {"cases"}, cases=[f"S.C{i}" for i in range(200)])
        for times in ({}, {f"S.C{i}": 0.5 for i in range(200)}, {"S.C7": 60.0}):
            parts = suites.parts_of(suite, times)
            self.assertGreater(len(parts), 2)
            self.assertEqual([c for p in parts for c in p.cases], suite.cases)

    def test_what_was_started_ends_with_the_runner(self):
        words = f"echo $$ > pid; kill -TERM {os.getpid()}; exec sleep 60"
        suite = suites.Suite("slow", ["sh", "-c", words], set(), folder=str(self.folder))
        status, told = self.run_all(of=[suite])
        self.assertEqual((status, told.splitlines()[-1]), (130, "interrupted"))
        with self.assertRaises(ProcessLookupError):
            os.kill(int((self.folder / "pid").read_text()), 0)

    def test_a_folder_that_is_no_build_is_told(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            self.assertEqual(run_tests.main(["--build", str(self.folder / "none")]), 3)
        self.assertIn("cannot ask for the tests of", told.getvalue())

    def test_times_are_kept(self):
        self.run_all(of=[self.speaker("One")])
        times = suites.read_times(self.folder / "test_times.json")
        self.assertEqual(times, {"Suite.One": 0.012})


class Reach(unittest.TestCase):
    DEPS = ["ice.o: #deps 2, deps mtime 1 (VALID)", "    ../../src/ice/a.cpp",
            "    ../../src/ice/a.hpp", "deck_test.o: #deps 1, deps mtime 1 (VALID)",
            "    ../../src/deck/deck_test.cpp"]
    INPUTS = {"bin/ice_test": ["ice.o", "libice.a"], "bin/deck_test": ["deck_test.o"]}

    def reach(self, *files):
        self.build = changed.ROOT / "build/none"

        def ninja(build, tool, *words):
            return self.DEPS if tool == "deps" else self.INPUTS[words[0]]
        with mock.patch.object(changed, "ninja", ninja):
            found = changed.Reach(self.build, files)
            for target in self.INPUTS:
                found.behind(self.build / target)
        return found

    def touched(self, *files):
        found = self.reach(*files)
        return {name: found.touches(suites.Suite(name, [str(self.build / "bin" / name)], {"cases"}))
                for name in ("ice_test", "deck_test")}

    def test_a_header_reaches_the_executables_made_of_it(self):
        self.assertEqual(self.touched("src/ice/a.hpp"), {"ice_test": True, "deck_test": False})
        self.assertEqual(self.touched("src/deck/deck_test.cpp"),
                         {"ice_test": False, "deck_test": True})
        self.assertEqual(self.touched("docs/a.md"), {"ice_test": False, "deck_test": False})

    def test_lint_is_always_reached_and_tools_by_what_is_not_compiled(self):
        lint, tools = suites.Suite("l", ["l"], {"lint"}), suites.Suite("t", ["t"], {"tools"})
        self.assertTrue(self.reach().touches(lint))
        self.assertFalse(self.reach().touches(tools))
        self.assertTrue(self.reach("tools/x.py").touches(tools))

    def test_rules_of_the_build_reach_everything(self):
        self.assertEqual(self.touched("src/ice/CMakeLists.txt"),
                         {"ice_test": True, "deck_test": True})


if __name__ == "__main__":
    unittest.main()
