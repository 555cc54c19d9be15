#!/usr/bin/env python3
"""Watch the memory of a run of many steps, with regrids and outputs on its way.

The run's resident memory is read every second. Once a twentieth of the steps is done it may grow
by no more than MOST. Exit 1 where it grows further, or the run does not end well.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

MOST = 2.0  # MB
FIRST = 0.05  # of the run: tables fill, the allocator finds its size


def resident(pid):
    """MB; None once the process is gone."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
    except (FileNotFoundError, ProcessLookupError):
        pass
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sluice", required=True)
    parser.add_argument("--deck", required=True, type=pathlib.Path)
    parser.add_argument("--folder", required=True, type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--outputs", type=int, default=200)
    parser.add_argument("--set", action="append", default=[], help="PATH=VALUE, as of sluice run")
    given = parser.parse_args()
    every = max(given.steps // given.outputs, 1)
    settings = ["Time/maxTime=1e9", f"Time/max_Timesteps={given.steps}",
                "DataArchiver/outputInterval=", f"DataArchiver/outputTimestepInterval={every}",
                "DataArchiver/checkpoint/@cycle=2",
                f"DataArchiver/checkpoint/@timestepInterval={every}"] + given.set
    report = given.folder / "report.json"
    words = [given.sluice, "run", str(given.deck), "-o", str(given.folder), "--progress", "none",
             "--json", str(report)] + [w for s in settings for w in ("--set", s)]
    begin = time.monotonic()
    with open(given.folder / "run.log", "wb") as log:
        run = subprocess.Popen(words, stdout=log, stderr=log)
    seen = []
    while run.poll() is None:
        seen.append((time.monotonic() - begin, resident(run.pid)))
        time.sleep(1)
    seconds = time.monotonic() - begin
    seen = [(at, mb) for at, mb in seen if mb is not None]
    if run.returncode != 0 or len(seen) < 20:
        print(f"RESULT: {given.deck.stem}: exit {run.returncode} after {seconds:.0f} s")
        return 1
    told = json.loads(report.read_text())
    settled = [mb for at, mb in seen if at > FIRST * seconds]
    growth = max(settled[len(settled) // 2:]) - max(settled[:max(len(settled) // 20, 1)])
    regrids = told.get("regrids", "?")
    good = growth <= MOST and told["steps"] == given.steps
    print(f"RESULT: {given.deck.stem}: {told['steps']} steps, {regrids} regrids, {given.outputs} "
          f"outputs in {seconds:.0f} s; memory {settled[0]:.1f} MB, growth {growth:+.2f} MB")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
