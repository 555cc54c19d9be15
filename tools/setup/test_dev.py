"""Tests of ./dev: its answers to misuse, and the frame of ./dev verify on parts made here."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def dev(*words):
    return subprocess.run([str(ROOT / "dev"), *words], capture_output=True, text=True)


class CommandLine(unittest.TestCase):
    def test_help_names_the_two_first_commands(self):
        told = dev("help")
        self.assertEqual(told.returncode, 0)
        self.assertIn("run DECK", told.stdout)
        self.assertIn("test [NAME...]", told.stdout)

    def test_misuse_is_bad_input_and_named(self):
        for words, expected in [(["nosuch"], "unknown command 'nosuch'"),
                                (["run"], "give a deck"),
                                (["run", "nosuch.ups"], "no file 'nosuch.ups'"),
                                (["setup", "nosuch"], "no package group 'nosuch'"),
                                (["clean", "../x"], "not a preset"),
                                (["verify", "nosuch"], "no part 'nosuch'"),
                                (["verify", "--limit", "soon"], "found 'soon', expected a whole")]:
            told = dev(*words)
            self.assertEqual(told.returncode, 2, words)
            self.assertIn(expected, told.stderr)

    def test_every_verify_part_says_what_it_does(self):
        told = dev("verify", "--list")
        self.assertEqual(told.returncode, 0)
        for line in told.stdout.splitlines():
            self.assertGreater(len(line.split()), 4, line)


class Functions(unittest.TestCase):
    """Functions of tools/setup, sourced into a bash of their own over a copied tree."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for part in ("setup", "verify"):
            shutil.copytree(ROOT / "tools" / part, self.root / "tools" / part)
        for script in (self.root / "tools/verify").glob("*.sh"):
            script.unlink()
        (self.root / "docs").mkdir()

    def bash(self, text):
        environment = dict(os.environ, SLUICE_ROOT=str(self.root), GIT_CEILING_DIRECTORIES="/")
        head = "set -euo pipefail; for p in say packages build run verify; do " \
               'source "$SLUICE_ROOT/tools/setup/$p.sh"; done; '
        return subprocess.run(["bash", "-c", head + text], capture_output=True, text=True,
                              env=environment)

    def part(self, name, text):
        script = self.root / f"tools/verify/{name}.sh"
        script.write_text("#!/usr/bin/env bash\n# does it\n" + text)

    def commit(self):
        git = ["git", "-C", str(self.root), "-c", "user.name=a", "-c", "user.email=a@b"]
        (self.root / ".gitignore").write_text("/build/\n")
        for words in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "a"]):
            subprocess.run(git + words, check=True)

    def test_missing_packages_are_only_those_missing(self):
        told = self.bash("missing_packages bash nosuch-package-at-all coreutils")
        self.assertEqual(told.stdout.split(), ["nosuch-package-at-all"])

    def test_logged_hands_on_status_and_shows_errors(self):
        told = self.bash("logged a step bash -c 'echo quiet; echo \"x.cpp:1: error: bad\"; exit 7'")
        self.assertEqual(told.returncode, 7)
        self.assertIn("x.cpp:1: error: bad", told.stderr)
        self.assertNotIn("quiet", told.stdout)

    def test_a_passed_part_is_kept_and_recorded(self):
        self.part("good", 'echo "RESULT: 3 of 3"\n')
        self.commit()
        told = self.bash("verify_part good; verify_part good")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(told.stdout.count("good: started"), 1)
        self.assertIn("good: passed already", told.stdout)
        page = (self.root / "docs/verification.md").read_text()
        self.assertRegex(page, r"\| good \| passed \| [0-9a-f]{12} \| .* \| 3 of 3 \|")

    def test_a_failed_part_is_recorded_and_repeated(self):
        self.part("bad", 'echo "RESULT: no | luck"\nfalse\necho "RESULT: never"\n')
        self.part("good", 'echo "RESULT: fine"\n')
        self.commit()
        told = self.bash("verify_part good; verify_part bad || echo told; verify_part bad || true")
        self.assertIn("told", told.stdout)
        self.assertEqual(told.stdout.count("bad: started"), 2)
        page = (self.root / "docs/verification.md").read_text()
        self.assertIn("| no / luck |", page)
        self.assertIn("| fine |", page)
        self.assertNotIn("never", page)

    def test_changed_sources_are_not_kept(self):
        self.part("good", 'echo "RESULT: fine"\n')
        self.commit()
        self.part("good", 'echo "RESULT: changed"\n')
        told = self.bash("verify_part good; verify_part good")
        self.assertEqual(told.stdout.count("good: started"), 2)
        self.assertIn("-changed |", (self.root / "docs/verification.md").read_text())

    def test_a_part_is_stopped_at_the_limit(self):
        self.part("slow", "sleep 20\n")
        self.commit()
        told = self.bash("PART_LIMIT=1; verify_part slow || echo stopped")
        self.assertIn("stopped", told.stdout)
        self.assertIn("stopped at the limit", (self.root / "docs/verification.md").read_text())


if __name__ == "__main__":
    unittest.main()
