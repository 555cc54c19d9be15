"""One process at work on a part of the tests: what its cases said, and how it ended."""
import dataclasses
import json
import os
import pathlib
import re
import signal
import subprocess
import time

LINE = re.compile(r"\[( RUN      |       OK |  FAILED  |  SKIPPED ) ?\] (\S+?)(?:,| \(|$)")
SECONDS = re.compile(r"\((\d+) ms\)$")
MOST_SHOWN = 200  # lines of a case


@dataclasses.dataclass
class Verdict:
    name: str
    outcome: str  # passed, failed, skipped
    seconds: float
    text: str = ""


class Work:
    """poll() until it returns False; then `verdicts`, and `left`: what it did not come to."""

    def __init__(self, part, scratch, grace=5.0):
        self.part, self.grace = part, grace
        self.verdicts, self.left = [], []
        self.waiting = list(part.cases or [])
        self.open_case, self.lines, self.rest, self.heard = None, [], "", 0
        self.report = pathlib.Path(scratch) / "report.json"
        self.log = open(pathlib.Path(scratch) / "log", "wb+")
        self.began = self.last_word = time.monotonic()
        self.stopped = False
        self.process = self.start(scratch)

    def start(self, scratch):
        # Launchers of ranks keep their session under a folder that all of a user share unless told
        # otherwise; one that ends removes what another that starts has just made.
        suite = self.part.suite
        environment = {**os.environ, "OMPI_MCA_orte_tmpdir_base": str(scratch),
                       **suite.environment}
        command = list(suite.command)
        if self.part.cases is not None:
            flags = pathlib.Path(scratch) / "flags"
            flags.write_text(f"--gtest_filter={':'.join(self.part.cases)}\n"
                             f"--gtest_output=json:{self.report}\n--gtest_color=no\n")
            command = [suite.executable, f"--gtest_flagfile={flags}"]
        if not command:
            raise OSError("it was not built")
        return subprocess.Popen(command, cwd=suite.folder, env=environment,
                                stdin=subprocess.DEVNULL, stdout=self.log,
                                stderr=subprocess.STDOUT, start_new_session=True)

    def poll(self):
        """Hears what was said; False once the process has ended and all is judged."""
        ended = self.process.poll() is not None
        self.hear()
        if not ended:
            if self.overdue():
                self.stop()
            else:
                return True
        self.judge_end()
        self.log.close()
        return False

    def overdue(self):
        return time.monotonic() - self.last_word > self.part.suite.timeout

    def stop(self):
        """Ends the process and its group; politely first, as launchers then end their ranks."""
        self.stopped = True
        for number, patience in ((signal.SIGTERM, self.grace), (signal.SIGKILL, None)):
            try:
                os.killpg(self.process.pid, number)
            except ProcessLookupError:
                pass
            try:
                self.process.wait(patience)
                return
            except subprocess.TimeoutExpired:
                continue

    def hear(self):
        # Read by place: the processes share the file's own position.
        file = self.log.fileno()
        size = os.fstat(file).st_size
        text = os.pread(file, size - self.heard, self.heard).decode(errors="replace")
        self.heard = size
        *lines, self.rest = (self.rest + text).split("\n")
        for line in lines:
            self.hear_line(line)

    def hear_line(self, line):
        found = LINE.search(line) if self.part.cases is not None else None
        word, name = (found.group(1).strip(), found.group(2)) if found else (None, None)
        if word == "RUN" and name in self.waiting and self.open_case is None:
            self.waiting.remove(name)
            self.open_case, self.lines = name, []
            self.last_word = time.monotonic()
        elif word not in (None, "RUN") and name == self.open_case:
            before = line[:found.start()]
            if before:
                self.lines.append(before)
            self.close({"OK": "passed", "SKIPPED": "skipped"}.get(word, "failed"), line)
        else:
            self.lines.append(line)

    def close(self, outcome, line="", words=""):
        took = SECONDS.search(line)
        now = time.monotonic()
        seconds = int(took.group(1)) / 1000 if took else now - self.last_word
        text = shortened(self.lines + ([words] if words else []))
        self.verdicts.append(Verdict(self.open_case, outcome, seconds, text))
        self.open_case, self.lines, self.last_word = None, [], now

    def judge_end(self):
        if self.rest:
            self.hear_line(self.rest)
        status = self.process.returncode
        words = how_it_ended(status, self.stopped, self.part.suite.timeout)
        if self.part.cases is None:
            self.judge_command(status, words)
            return
        if self.open_case is not None:
            self.close("failed", words=f"{words} in this case")
            self.left = self.waiting  # a crash hides nothing: the others get a process of their own
            return
        failed = self.reconcile()
        if self.waiting:
            self.verdicts.append(Verdict(self.part.suite.name, "failed", 0, shortened(
                self.lines + [f"{words} before {self.waiting[0]}"])))
            # Where nothing ran, another process would do no better.
            self.left = self.waiting if len(self.waiting) < len(self.part.cases) else []
        elif status != 0 and not failed:
            self.verdicts.append(Verdict(self.part.suite.name, "failed", 0, shortened(
                self.lines + [f"{words} after the last case"])))

    def judge_command(self, status, words):
        outcome = "passed" if status == 0 and not self.stopped else "failed"
        if status == self.part.suite.skip_status and not self.stopped:
            outcome = "skipped"
        self.open_case = self.part.suite.name
        self.last_word = self.began
        self.close(outcome, words=words if outcome == "failed" else "")

    def reconcile(self):
        """googletest's own report has the last word: what it calls failed has failed."""
        failed = failed_in(self.report)
        for verdict in self.verdicts:
            if verdict.name in failed:
                verdict.outcome = "failed"
                verdict.text = verdict.text or failed[verdict.name]
        return failed


def failed_in(report):
    """Names of failed cases in googletest's JSON, with what failed; none without a report."""
    try:
        told = json.loads(pathlib.Path(report).read_text(errors="replace"))
    except (OSError, ValueError):
        return {}
    return {f"{group['name']}.{case['name']}": case["failures"][0].get("failure", "")
            for group in told.get("testsuites", []) for case in group.get("testsuite", [])
            if case.get("failures")}


def how_it_ended(status, stopped, timeout):
    if stopped:
        return f"stopped after {timeout:g} s"
    if status is not None and status < 0:
        return f"the process ended by {signal.Signals(-status).name}"
    return f"the process ended with exit status {status}"


def shortened(lines):
    if len(lines) > MOST_SHOWN:
        half = MOST_SHOWN // 2
        lines = lines[:half] + [f"... {len(lines) - 2 * half} lines ..."] + lines[-half:]
    return "\n".join(lines)
