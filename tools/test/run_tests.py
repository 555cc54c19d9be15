#!/usr/bin/env python3
"""Run the tests of a build folder: suites in few processes, on all cores, long ones first.

What there is comes from ctest's registry; executables labelled `cases` are asked for theirs. A case
that fails is shown with its name and output; so is the case at which a process died or hung, and
the cases behind it run all the same. The last line is `N passed, N failed`.

    run_tests.py --build FOLDER [NAME...] [-R NAME] [-E NAME] [-L LABEL] [--changed] [--full]
"""
import argparse
import difflib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import changed
import suites
import work

POLL = 0.02  # seconds between looks at the processes
TELL = 20  # seconds between lines of progress where there is no terminal


def parse(words):
    p = argparse.ArgumentParser(prog="./dev test", description=__doc__.splitlines()[0],
                                allow_abbrev=False)
    p.add_argument("names", nargs="*", metavar="NAME",
                   help="as after -R; of an executable: all its cases")
    p.add_argument("-R", dest="also", action="append", default=[], metavar="NAME",
                   help="only tests and cases in whose name this regular expression is found")
    p.add_argument("-E", dest="without", action="append", default=[], metavar="NAME",
                   help="none in whose name it is found")
    p.add_argument("-L", dest="labels", action="append", default=[], metavar="LABEL",
                   help="only tests of this label: lint, tools, golden, verification, properties")
    p.add_argument("-LE", dest="without_labels", action="append", default=[], metavar="LABEL")
    p.add_argument("--changed", action="store_true",
                   help="only what files changed against origin/main (else HEAD~) can reach")
    p.add_argument("--full", dest="full", action="store_const", const="also", default="no",
                   help="with the full products, that ./dev verify properties runs")
    p.add_argument("--full-only", dest="full", action="store_const", const="only",
                   help="only these")
    p.add_argument("-j", dest="jobs", type=int, default=os.cpu_count(), metavar="N")
    p.add_argument("--timeout", type=float, metavar="SECONDS", help="of a case, of a command")
    p.add_argument("--list", action="store_true", help="only name them")
    p.add_argument("--log", help=argparse.SUPPRESS)  # gets the output of every case
    p.add_argument("--times", help="file that gets the seconds of every case")
    p.add_argument("--build", required=True, help=argparse.SUPPRESS)
    return p.parse_intermixed_args(words)


class Teller:
    """Speaks to the user: failures at once, progress in between, the count at the end."""

    def __init__(self, total, log=None, stream=None):
        self.total, self.log = total, log
        self.stream = stream or sys.stdout
        self.moving = self.stream.isatty()
        self.done, self.last = [], time.monotonic()

    def line(self, text):
        if self.moving:
            self.stream.write("\r\033[K")
        print(text, file=self.stream, flush=True)
        if self.log:
            print(text, file=self.log, flush=True)

    def tell(self, verdict):
        self.done.append(verdict)
        if verdict.outcome != "passed":
            self.line(f"{verdict.outcome.upper()} {verdict.name} ({verdict.seconds:.2f} s)")
        elif self.log:
            print(f"passed {verdict.name} ({verdict.seconds:.2f} s)", file=self.log)
        if verdict.outcome == "failed":
            self.line(verdict.text)
        elif self.log and verdict.text:
            print(verdict.text, file=self.log)

    def progress(self, at_work):
        """`at_work`: cases done by processes that have not ended yet."""
        words = f"== tests: {len(self.done) + at_work} of {self.total}"
        if self.moving:
            self.stream.write(f"\r{words} \033[K")
            self.stream.flush()
        elif time.monotonic() - self.last >= TELL:
            self.last = time.monotonic()
            print(words, file=self.stream, flush=True)

    def close(self):
        """The failed ones once more, the skipped ones by number; the count. True: all is well."""
        failed = [v for v in self.done if v.outcome == "failed"]
        skipped = [v for v in self.done if v.outcome == "skipped"]
        if failed:
            self.line("failed:")
        for verdict in failed:
            self.line(f"  {verdict.name}")
        if skipped:
            self.line(f"{len(skipped)} skipped")
        self.line(f"{len(self.done) - len(failed) - len(skipped)} passed, {len(failed)} failed")
        return not failed


def run(parts, jobs, teller, scratch, ending):
    """All parts, never more than `jobs` slots at a time: those that need several first, then long
    before short."""
    waiting = sorted(parts, key=lambda p: (-min(p.suite.slots, jobs), -p.seconds))
    at_work, number = [], 0
    try:
        while (waiting or at_work) and not ending.asked:
            free = jobs - sum(min(w.part.suite.slots, jobs) for w in at_work)
            if waiting and min(waiting[0].suite.slots, jobs) <= free:
                number += 1
                folder = scratch / str(number)
                folder.mkdir()
                part = waiting.pop(0)
                try:
                    at_work.append(work.Work(part, folder))
                except OSError as fault:
                    words = f"cannot start: {fault}"
                    teller.tell(work.Verdict(part.suite.name, "failed", 0, words))
                continue
            still = []
            for w in at_work:
                if w.poll():
                    still.append(w)
                    continue
                for verdict in w.verdicts:
                    teller.tell(verdict)
                if w.left:
                    waiting.insert(0, suites.Part(w.part.suite, w.left, w.part.seconds))
            at_work = still
            teller.progress(sum(len(w.verdicts) for w in at_work))
            time.sleep(POLL)
    finally:
        for w in at_work:
            w.stop()
            w.log.close()


def selected(options, teller):
    """The suites asked for, with those of their cases that are."""
    choice = suites.Selection(options.names + options.also, options.without, options.labels,
                              options.without_labels, options.full)
    chosen, known = [], []
    everything = suites.registered(options.build)
    reach = changed.Reach(options.build) if options.changed else None
    for suite in everything:
        if options.timeout:
            suite.timeout = options.timeout
        if not choice.takes_suite(suite) or (reach and not reach.touches(suite)):
            continue
        if suites.CASES_LABEL in suite.labels:
            if choice.names and not suite.command:  # named ones may be of what is there
                continue
            try:
                names = suites.list_cases(suite)
            except OSError as fault:
                words = f"cannot list its cases: {fault}"
                teller.tell(work.Verdict(suite.name, "failed", 0, words))
                continue
            known += names
            suite.cases = [n for n in names if choice.takes(n, suite.name)]
            if suite.cases:
                chosen.append(suite)
        else:
            known.append(suite.name)
            if choice.takes(suite.name):
                chosen.append(suite)
    return chosen, known


def none_matches(options, known):
    words = "no test matches"
    for name in options.names + options.also:
        near = difflib.get_close_matches(name, known, 1, 0.3)
        words += f" '{name}'" + (f" (nearest: {near[0]})" if near else "")
    print(f"dev: {words}", file=sys.stderr)
    return 2


class Ending:
    """Set by a signal to end, and looked at between processes: none is left behind half started."""
    asked = False

    def __init__(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self.ask)

    def ask(self, *_):
        self.asked = True


def main(words):
    options = parse(words)
    ending = Ending()
    log = open(options.log, "w", encoding="utf-8") if options.log else None
    teller = Teller(0, log)
    try:
        chosen, known = selected(options, teller)
    except (OSError, subprocess.CalledProcessError) as fault:
        print(f"dev: cannot ask for the tests of {options.build}: {fault}", file=sys.stderr)
        return 3
    if not chosen and not teller.done:
        if options.changed:
            teller.line("nothing that changed is reached by a test")
            return 0 if teller.close() else 1
        return none_matches(options, known)
    if options.list:
        for suite in chosen:
            print("\n".join(suite.cases if suite.cases is not None else [suite.name]))
        return 0
    teller.total = sum(1 if s.cases is None else len(s.cases) for s in chosen)
    kept = pathlib.Path(options.build) / "test_times.json"
    times = suites.read_times(kept)
    parts = [part for suite in chosen for part in suites.parts_of(suite, times)]
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="sluice_tests_"))
    began = time.monotonic()
    try:
        run(parts, options.jobs, teller, scratch, ending)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    if ending.asked:
        teller.line("interrupted")
        return 130
    measured = {v.name: v.seconds for v in teller.done if v.outcome != "skipped"}
    kept.write_text(json.dumps(times | measured, indent=0, sort_keys=True))
    if options.times:
        pathlib.Path(options.times).write_text(json.dumps(measured, indent=0, sort_keys=True))
    teller.line(f"== {time.monotonic() - began:.0f} s on {options.jobs} cores")
    return 0 if teller.close() else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
