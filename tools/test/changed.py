"""Which tests the files changed against git can reach, by ninja's record of what was compiled."""
import pathlib
import subprocess

import suites

ROOT = pathlib.Path(__file__).resolve().parents[2]
ALWAYS = "lint"  # label of tests that read every source
OF_TESTS = ("inputs/", "regression/", "src/")  # where files lie that executables of tests read


def git(*words):
    told = subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True)
    return told.stdout.splitlines() if told.returncode == 0 else []


def changed_files():
    """Paths from the root: the working tree, and commits since origin/main or else HEAD~."""
    base = (git("merge-base", "HEAD", "origin/main") or git("rev-parse", "HEAD~"))[:1]
    return set(git("diff", "--name-only", *base)) | \
        set(git("ls-files", "--others", "--exclude-standard"))


def ninja(build, *words):
    return subprocess.run(["ninja", "-C", str(build), "-t", *words], capture_output=True,
                          text=True, check=True).stdout.splitlines()


class Reach:
    """touches(suite): whether a changed file is behind the suite's executable, or what it reads."""

    def __init__(self, build, files=None):
        self.build = pathlib.Path(build).resolve()
        self.files = changed_files() if files is None else set(files)
        self.headers = self.read_headers()
        self.inputs = {}
        compiled = {f for deps in self.headers.values() for f in deps}
        # Decks, golden results, tools: read when tests run. Rules of the build reach everything.
        self.read = {f for f in self.files if f not in compiled and not f.startswith("docs/")}
        self.rules = any("cmake" in f.lower() for f in self.files)

    def from_root(self, path):
        full = pathlib.Path(path)
        full = full if full.is_absolute() else self.build / full
        try:
            return str(full.resolve().relative_to(ROOT))
        except ValueError:
            return None

    def read_headers(self):
        """Of each object the files of this checkout that it was compiled from."""
        known, deps, files = {}, {}, None
        for line in ninja(self.build, "deps"):
            if line.startswith("    "):
                path = line.strip()
                if path not in known:
                    known[path] = self.from_root(path)
                if known[path]:
                    files.add(known[path])
            elif ": #deps" in line:
                files = deps.setdefault(line.split(":")[0], set())
        return deps

    def behind(self, executable):
        """The files of this checkout that an executable of the build is made of."""
        try:
            target = str(pathlib.Path(executable).resolve().relative_to(self.build))
        except ValueError:
            return set()
        if not target.startswith("bin/"):
            return set()
        if target not in self.inputs:
            found = set()
            for one in ninja(self.build, "inputs", target):
                found |= self.headers.get(one, set())
            self.inputs[target] = found
        return self.inputs[target]

    def touches(self, suite):
        if ALWAYS in suite.labels or self.rules:
            return True
        sources = set().union(*map(self.behind, suite.command))
        if sources & self.files:
            return True
        if suites.CASES_LABEL not in suite.labels:
            return bool(self.read)
        return any(f.startswith(OF_TESTS) for f in self.read) and \
            any(self.reads_checkout(source) for source in sources)

    def reads_checkout(self, source):
        """Whether a test opens files of the checkout, as decks."""
        if not source.endswith("_test.cpp") and not source.startswith("regression/"):
            return False
        file = ROOT / source
        return file.is_file() and "SLUICE_SOURCE_DIR" in file.read_text(encoding="utf-8")
