#!/usr/bin/env python3
"""Kill runs at random moments, restart each, and compare the end with an uninterrupted run.

After every kill the archive must be undamaged (`sluice info --verify`). A killed run is restarted
from its last checkpoint, or started again when it had none yet, until it finishes; then every
output and history must equal the uninterrupted run's to the bit. Exit 1 at the first difference.

With --ranks N every start and restart takes a random number of ranks up to N, and one rank alone is
killed: the others must end by themselves. The uninterrupted run has one rank.
"""
import argparse
import filecmp
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

SETTINGS = ["DataArchiver/outputInterval=", "DataArchiver/outputTimestepInterval=20",
            "DataArchiver/checkpoint/@cycle=2", "DataArchiver/checkpoint/@timestepInterval=15"]


ENDS = 60  # seconds in which the other ranks end once one is killed
START = 0.8  # seconds that ranks take to begin


class Run:
    """A process, or the ranks of one run under mpiexec."""

    def __init__(self, words, ranks, log):
        self.ranks = ranks
        if ranks > 1:
            words = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)] + words
        self.process = subprocess.Popen(words, stdout=log, stderr=log)

    def wait(self, timeout=None):
        return self.process.wait(timeout=timeout)

    def kill(self):
        """Kills the process, or one of the ranks, and waits for the end of all."""
        one = self.process.pid
        if self.ranks > 1:
            told = subprocess.run(["pgrep", "-P", str(one)], capture_output=True, text=True)
            # None: they have not begun yet, or are at their end.
            one = int(random.choice(told.stdout.split() or [str(one)]))
        try:
            os.kill(one, signal.SIGKILL)
        except ProcessLookupError:
            pass
        try:
            self.process.wait(timeout=ENDS)
        except subprocess.TimeoutExpired:
            self.process.kill()
            fail(f"{ENDS} s after one of {self.ranks} ranks was killed the others still run")


class Runner:
    def __init__(self, given):
        self.ranks = given.ranks
        self.sluice, self.deck, self.folder = given.sluice, given.deck, given.folder
        self.settings = SETTINGS + [f"Time/max_Timesteps={given.steps}"] + given.set

    def command(self, name, restart=None):
        words = [self.sluice, "run", "-o", str(self.folder / name), "--progress", "none",
                 "--json", str(self.folder / f"{name}.json")]
        if restart:
            return words + ["--restart", str(restart)]  # with the deck that the archive keeps
        for setting in self.settings:
            words += ["--set", setting]
        return words + [self.deck]

    def start(self, name, restart=None, ranks=1):
        log = open(self.folder / f"{name}.log", "ab")
        return Run(self.command(name, restart), ranks, log)

    def archives(self, name):
        # Not the links under temporary names that a kill may leave.
        return sorted((self.folder / name).glob("*.uda.[0-9][0-9][0-9]"))

    def told(self, *words):
        return subprocess.run([self.sluice, *map(str, words)], capture_output=True, text=True)


def has_checkpoint(archive):
    index = archive / "checkpoints/index.xml"
    return index.exists() and "<timestep " in index.read_text()


def fail(text):
    print(f"RESULT: {text}")
    sys.exit(1)


def check_archive(runner, archive):
    if not (archive / "index.xml").exists():
        return  # killed before there was anything to index
    told = runner.told("info", archive, "--verify")
    if told.returncode != 0:
        fail(f"{archive.name} is damaged after a kill: {told.stdout[-300:]}{told.stderr[-300:]}")


def compare(runner, reference, archive):
    told = runner.told("compare", reference, archive)
    if told.returncode != 0:
        fail(f"differs from the uninterrupted run: {told.stdout[-300:]}{told.stderr[-300:]}")
    for history in sorted(reference.glob("*.dat")):
        if not filecmp.cmp(history, archive / history.name, shallow=False):
            fail(f"{history.name} differs from the uninterrupted run's")


def one_sequence(runner, name, wall, budget):
    """Kills until a run finishes or the budget is used up; the number of kills."""
    (runner.folder / name).mkdir()
    kills = 0
    while True:
        # Each restart writes an archive of its own; the newest with a checkpoint goes furthest.
        good = [archive for archive in runner.archives(name) if has_checkpoint(archive)]
        process = runner.start(name, good[-1] if good else None, random.randint(1, runner.ranks))
        if kills < budget:
            try:
                process.wait(timeout=random.uniform(0.01, 0.9 * wall))
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
                for archive in runner.archives(name):
                    check_archive(runner, archive)
                continue
        if process.wait() != 0:
            fail(f"a restarted run ended with {process.returncode}; see {name}.log")
        return kills, runner.archives(name)[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--deck", required=True)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--steps", type=int, default=300)
    parser.add_argument("--ranks", type=int, default=1, help="the most ranks of a run")
    parser.add_argument("--set", action="append", default=[], help="PATH=VALUE, as of sluice run")
    parser.add_argument("--seed", type=int, default=int(time.time()))
    given = parser.parse_args()
    random.seed(given.seed)
    print(f"seed {given.seed}")

    runner = Runner(given)
    (given.folder / "reference").mkdir(parents=True)
    begin = time.monotonic()
    if runner.start("reference").wait() != 0:
        fail("the uninterrupted run failed; see reference.log")
    wall = time.monotonic() - begin
    reference = runner.archives("reference")[-1]
    if given.ranks > 1:
        (given.folder / "on_ranks").mkdir()
        if runner.start("on_ranks", None, given.ranks).wait() != 0:
            fail(f"the uninterrupted run on {given.ranks} ranks failed; see on_ranks.log")
        wall += START
        compare(runner, reference, runner.archives("on_ranks")[-1])
    steps = json.loads((given.folder / "reference.json").read_text())["steps"]

    kills = sequences = 0
    while kills < given.kills:
        sequences += 1
        done, archive = one_sequence(runner, f"killed{sequences}", wall, given.kills - kills)
        kills += done
        compare(runner, reference, archive)
        print(f"   sequence {sequences}: {done} kills, equal to the bit ({kills} in all)",
              flush=True)
    on = f" on 1 to {given.ranks} ranks" if given.ranks > 1 else ""
    print(f"RESULT: {pathlib.Path(given.deck).stem}: {kills} kills in {sequences} runs of {steps} "
          f"steps{on} ({wall:.1f} s each): every archive undamaged, every end equal to the bit")


if __name__ == "__main__":
    main()
