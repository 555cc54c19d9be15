"""What tests there are: those that ctest knows, and the cases inside googletest executables."""
import dataclasses
import json
import pathlib
import re
import subprocess

CASES_LABEL = "cases"  # of a googletest executable: its cases are selected and told one by one
# Names of cases that ./dev verify properties runs: Full/Suite.Case, FullSuite.Case, Suite.FullCase.
FULL = re.compile(r"(^|\.)Full(/|[A-Z])")
# Seconds of a case that has not been timed here yet: of a function, of whole runs.
UNKNOWN_SECONDS, UNKNOWN_RUN = 0.05, 0.5
RUNS = {"verification", "properties"}  # labels of suites whose cases are whole runs


@dataclasses.dataclass
class Suite:
    """One test of ctest: a command, or a googletest executable with its cases."""
    name: str
    command: list
    labels: set
    timeout: float = 600.0  # of the command; of each case
    slots: int = 1  # cores that it keeps busy
    folder: str = "."
    environment: dict = dataclasses.field(default_factory=dict)
    skip_status: int | None = None
    cases: list | None = None  # names; none: a command

    @property
    def executable(self):
        return self.command[0] if self.command else None


def registered(build):
    """The suites that ctest knows in a build folder."""
    told = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"],
                          capture_output=True, text=True, check=True)
    return [suite_of(entry) for entry in json.loads(told.stdout)["tests"]]


def suite_of(entry):
    said = {p["name"]: p["value"] for p in entry.get("properties", [])}
    environment = dict(pair.split("=", 1) for pair in said.get("ENVIRONMENT", []))
    return Suite(entry["name"], entry.get("command", []), set(said.get("LABELS", [])),
                 timeout=float(said.get("TIMEOUT", 600)), slots=int(said.get("PROCESSORS", 1)),
                 folder=said.get("WORKING_DIRECTORY", "."), environment=environment,
                 skip_status=said.get("SKIP_RETURN_CODE"))


def list_cases(suite):
    """The names that the executable of a suite lists; disabled ones left out."""
    if not suite.command:
        raise OSError("it was not built")
    told = subprocess.run([suite.executable, "--gtest_list_tests"], cwd=suite.folder,
                          capture_output=True, text=True, timeout=suite.timeout)
    if told.returncode != 0:
        raise OSError(f"exit status {told.returncode}: {told.stderr.strip()[-300:]}")
    return parse_list(told.stdout)


def parse_list(text):
    names, group = [], ""
    for line in text.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith("  "):
            names.append(group + word)
        elif word.endswith("."):
            group = word
    return [n for n in names if "DISABLED_" not in n]


@dataclasses.dataclass
class Selection:
    """Names and labels asked for, as patterns found anywhere in them."""
    names: list = dataclasses.field(default_factory=list)
    without: list = dataclasses.field(default_factory=list)
    labels: list = dataclasses.field(default_factory=list)
    without_labels: list = dataclasses.field(default_factory=list)
    full: str = "no"  # cases of the full products: "no", "also" or "only"

    def takes_suite(self, suite):
        def found(pattern):
            return any(re.search(pattern, label) for label in suite.labels)
        return all(map(found, self.labels)) and not any(map(found, self.without_labels))

    def takes(self, name, suite=""):
        """Whether a name is asked for; that of an executable asks for all its cases."""
        if self.full != "also" and bool(FULL.search(name)) != (self.full == "only"):
            return False
        if self.names and not any(re.search(p, name) or p == suite for p in self.names):
            return False
        return not any(re.search(p, name) for p in self.without)


@dataclasses.dataclass
class Part:
    """What one process does: a command, or some cases of an executable."""
    suite: Suite
    cases: list | None
    seconds: float  # expected


def parts_of(suite, times, longest=10.0, most=60):
    """Parts of a suite: processes of about `longest` seconds, so that all cores have work."""
    if suite.cases is None:
        return [Part(suite, None, times.get(suite.name, 1.0))]
    parts, cases, seconds = [], [], 0.0
    unknown = UNKNOWN_RUN if suite.labels & RUNS else UNKNOWN_SECONDS
    for name in suite.cases:
        expected = times.get(name, unknown)
        new_here = sum(n not in times for n in cases)
        if cases and (seconds + expected > longest or new_here >= most):
            parts.append(Part(suite, cases, seconds))
            cases, seconds = [], 0.0
        cases.append(name)
        seconds += expected
    if cases:
        parts.append(Part(suite, cases, seconds))
    return parts


def read_times(file):
    try:
        return json.loads(pathlib.Path(file).read_text())
    except (OSError, ValueError):
        return {}
