#!/usr/bin/env python3
"""Tell which tests take over a second, and fail for those over five.

Seconds are counted as on the machine of tools/bench/recorded.json: the fixed loop of
sluice_calibration, timed now, says how much slower this one is. Whole suites of Python tests and
commands over many decks are one test each and may take longer.

    costs.py TIMES --calibration sluice_calibration
"""
import argparse
import json
import pathlib
import subprocess
import sys

RECORDED = pathlib.Path(__file__).resolve().parents[1] / "bench/recorded.json"
TOLD, MOST = 1.0, 5.0  # seconds
LARGE = {"tools.ice_decks": 20.0, "tools.scenes": 20.0, "tools.pictures": 15.0}


def slowness(calibration, repeat=3):
    """How many times slower than the recorded machine this one is."""
    loops = [float(subprocess.run([calibration], capture_output=True, text=True, check=True).stdout)
             for _ in range(repeat)]
    return sorted(loops)[repeat // 2] / json.loads(RECORDED.read_text())["calibration_ns"]


def told(times, slow):
    """Lines for the tests over a second, the longest first; names of those that take too long."""
    counted = sorted(((seconds / slow, name) for name, seconds in times.items()), reverse=True)
    lines = [f"{seconds:8.2f} s  {name}" for seconds, name in counted if seconds > TOLD]
    return lines, [name for seconds, name in counted if seconds > LARGE.get(name, MOST)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("times", type=pathlib.Path)
    parser.add_argument("--calibration", required=True)
    given = parser.parse_args()
    times, slow = json.loads(given.times.read_text()), slowness(given.calibration)
    lines, over = told(times, slow)
    print("\n".join(lines))
    print(f"this machine takes {slow:.2f} times the recorded time")
    print(f"RESULT: {len(times)} tests, {sum(times.values()) / slow:.0f} s, {len(lines)} over "
          f"{TOLD:g} s" + (f"; too long: {', '.join(over)}" if over else ""))
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
