#!/usr/bin/env python3
"""Measure what a cell and step cost, beside the figures recorded before.

    bench.py                    all cases, a table against recorded.json
    bench.py 3-D                cases whose name contains 3-D
    bench.py --long             with the cases that take minutes
    bench.py --record           and store the medians as the new recorded figures
    bench.py --against COMMIT   build COMMIT under build/against and run both in turn
    bench.py --processor        processor time of steps alone: minima, for machines with other work
    bench.py --instructions     count instructions per cell and step (valgrind, repeatable)

Each figure is the median of several runs, pinned to one core; a fixed calibration loop timed in the
same minute stands beside it, so that a noisy or slower machine shows. Exit 1 when a limit of
cases.py is exceeded, unless the machine is noisy (then it says so and exits 0).
"""
import argparse
import datetime
import json
import pathlib
import platform
import subprocess
import sys

from cases import CASES, Program, Ratio, Run
from measure import (Build, build_portable, count_instructions, kernel_figures,
                     least_processor_times, median_runs, program_figures, spread)
from table import print_table

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORDED = ROOT / "tools/bench/recorded.json"
NOISY = 0.10  # a calibration that varies by more than this in one bench is not to be trusted


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pattern", nargs="*", help="only cases whose name contains one of these")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--against", metavar="COMMIT")
    parser.add_argument("--instructions", action="store_true")
    parser.add_argument("--processor", action="store_true")
    parser.add_argument("--repeat", type=int, default=5, help="runs per figure (5)")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures there too")
    return parser.parse_args()


def wanted(cases, patterns):
    """The cases that match, and the runs that matching ratios need."""
    chosen = [c for c in cases if any(p in c.name for p in patterns)
              or not (patterns or getattr(c, "by_name", False))]
    needed = {n for c in chosen if isinstance(c, Ratio) for n in (c.above, c.below)}
    return [c for c in cases if c in chosen or c.name in needed]


def long_names(cases):
    """The runs that take minutes, and the ratios made of them."""
    runs = {c.name for c in cases if isinstance(c, Run) and c.long}
    return runs | {c.name for c in cases if isinstance(c, Ratio) and runs & {c.above, c.below}}


def without_long(cases):
    """Says what it leaves out."""
    names = long_names(cases)
    if names:
        print("left out, for they take minutes (--long): " + "; ".join(sorted(names)))
    return [c for c in cases if c.name not in names]


def other_figures(build, cases, patterns):
    programs = [case for case in cases if isinstance(case, Program)]
    return program_figures(build, programs) | kernel_figures(build, patterns)


def figures_of(cases, runs):
    """Median per case name: of the runs, and of the ratios made of them."""
    figures = dict(runs)
    for case in cases:
        if isinstance(case, Ratio) and figures.get(case.below) and figures.get(case.above):
            figures[case.name] = figures[case.above] / figures[case.below]
    return figures


def commit_of(root):
    described = subprocess.run(["git", "-C", str(root), "describe", "--always", "--exclude=*",
                                "--dirty=-changed"], capture_output=True, text=True)
    return described.stdout.strip() or "unknown"


def checkout_and_build(commit):
    """The release build of COMMIT under build/against; kept for the next time."""
    name = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short=12", commit + "^{commit}"],
                          capture_output=True, text=True)
    if name.returncode != 0:
        sys.exit(f"bench: git knows no commit '{commit}'")
    folder = ROOT / "build/against" / name.stdout.strip()
    if not (folder / "CMakeLists.txt").exists():
        folder.mkdir(parents=True, exist_ok=True)
        archive = subprocess.run(["git", "-C", str(ROOT), "archive", name.stdout.strip()],
                                 capture_output=True, check=True).stdout
        subprocess.run(["tar", "-x", "-C", str(folder)], input=archive, check=True)
    print(f"== building {name.stdout.strip()} under {folder.relative_to(ROOT)}", flush=True)
    for command in (["cmake", "--preset", "release", "-DSLUICE_TESTS=OFF"],
                    ["cmake", "--build", "--preset", "release"]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"bench: {' '.join(command)} failed in {folder}:\n{done.stdout[-3000:]}")
    return Build(folder, "release")


def read_recorded():
    old = json.loads(RECORDED.read_text()) if RECORDED.exists() else {}
    return {"figures": {}, "instructions": {}} | old


def write_recorded(recorded, kind, figures):
    recorded[kind].update({name: round(value, 4) for name, value in figures.items()})
    RECORDED.write_text(json.dumps(recorded, indent=1, sort_keys=True) + "\n")
    print(f"recorded {len(figures)} {kind} in {RECORDED.relative_to(ROOT)}")


def record(figures, calibration):
    recorded = read_recorded()
    for name in long_names(CASES) - figures.keys():
        if recorded["figures"].pop(name, None) is not None:
            print(f"dropped '{name}', which is of another commit: --long records it")
    recorded.update(calibration_ns=round(calibration, 6), commit=commit_of(ROOT),
                    date=datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"),
                    machine=processor_name())
    write_recorded(recorded, "figures", figures)


def instructions(cases, keep):
    """Instructions per cell and step, beside the recorded ones: they do not depend on load."""
    recorded, build, counts = read_recorded(), build_portable(ROOT), {}
    print(f"{'instructions per cell and step':34} {'now':>10} {'recorded':>10} {'change':>9}")
    for case in cases:
        if case.ranks * case.threads > 1 or case.unit != "ns/cell/step" or not case.steps:
            continue
        now = counts[case.name] = count_instructions(build, case)
        before = recorded["instructions"].get(case.name)
        change = f"{100 * (now / before - 1):+.1f} %" if before else "-"
        told = f"{before:.1f}" if before else "-"
        print(f"{case.name:34} {now:10.1f} {told:>10} {change:>9}", flush=True)
    if keep:
        write_recorded(recorded, "instructions", counts)
    return 0


def processor(builds, cases, repeat):
    """Processor time per cell or particle and step, of one build or of two beside each other."""
    print(f"{'processor time, ns':44} {'now':>10} {'other':>10} {'ratio':>7}")
    for case in cases:
        if not case.steps or not case.unit.startswith("ns"):
            continue
        now, *other = least_processor_times(builds, case, repeat)
        told = f"{other[0]:10.1f} {now / other[0]:7.3f}" if other else f"{'-':>10} {'-':>7}"
        print(f"{case.name:44} {now:10.1f} {told}", flush=True)
    return 0


def processor_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or "unknown"


def main():
    given = parse()
    cases = wanted(CASES, given.pattern)
    if not given.long:
        cases = without_long(cases)
    if given.instructions:
        return instructions([c for c in cases if isinstance(c, Run)], given.record)
    build = Build(ROOT, "release")
    builds = [build] + ([checkout_and_build(given.against)] if given.against else [])
    run_cases = [case for case in cases if isinstance(case, Run)]
    if given.processor:
        return processor(builds, run_cases, given.repeat)
    runs, calibrations = median_runs(builds, run_cases, given.repeat)
    mine = figures_of(cases, runs[0]) | other_figures(build, cases, given.pattern)
    if not mine:
        sought = " or ".join(map(repr, given.pattern))
        sys.exit(f"bench: nothing to measure, no case that may run now holds {sought}; there are:\n"
                 + "\n".join(f"  {case.name}" for case in CASES))
    recorded = read_recorded()
    if given.against:
        theirs = figures_of(cases, runs[1]) | other_figures(builds[1], cases, given.pattern)
        other = {"figures": theirs, "calibration_ns": calibrations[len(calibrations) // 2],
                 "commit": given.against}
    else:
        other = recorded
    calibration = sorted(calibrations)[len(calibrations) // 2]
    faults = print_table(cases, mine, other, calibration)
    noise = spread(calibrations)
    print(f"calibration {calibration:.4f} ns per element, spread {100 * noise:.0f} %")
    if given.json:
        given.json.write_text(json.dumps({"figures": mine, "against": other,
                                          "calibration_ns": calibrations}, indent=1) + "\n")
    if given.record:
        record(mine, calibration)
    if faults and noise > NOISY:
        print("limits exceeded, but the machine is noisy: repeat on a quiet one")
        return 0
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
