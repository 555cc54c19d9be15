"""Running the cases: pinned, repeated, several builds in turn; instruction counts by valgrind."""
import dataclasses
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from cases import CASES, SUITE, Program

TWO_CORES = "0,1"
ONE_CORE = "0"


@dataclasses.dataclass(frozen=True)
class Build:
    root: pathlib.Path
    preset: str

    @property
    def bin(self):
        return self.root / "build" / self.preset / "bin"


def spread(values):
    return (max(values) - min(values)) / statistics.median(values) if values else 0.0


def run_command(build, case, report, steps, prefix=()):
    command = ["taskset", "-c", ONE_CORE if case.ranks * case.threads == 1 else TWO_CORES]
    if case.ranks > 1:
        command += ["mpirun", "-np", str(case.ranks)]
    command += [*prefix, str(build.bin / "sluice"), "run", str(build.root / case.deck),
                "--threads", str(case.threads), "--no-output", "--progress", "none",
                "--json", str(report)]
    if steps:
        command += ["--max-steps", str(steps)]
    if case.resolution:
        command += ["--set", "Grid/Level/Box/resolution=" + case.resolution]
    for setting in case.settings:
        command += ["--set", setting]
    if not case.savings:
        command.append("--force-all")
    return command


def run_once(build, case):
    """Nanoseconds per cell and step of one run, or its milliseconds where the case says so."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = run_command(build, case, report, case.steps)
        if SUITE:  # the suite's decks name the files they include from the folder above inputs
            pathlib.Path(folder, "inputs").symlink_to(pathlib.Path(SUITE, "inputs").resolve())
        began = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
        wall = time.monotonic() - began
        if done.returncode != 0:
            sys.exit(f"bench: '{case.name}' failed ({done.returncode}):\n{done.stderr[-2000:]}")
        told = json.loads(report.read_text())
        if told["steps"] < case.steps:
            print(f"note: '{case.name}' ended after {told['steps']} of {case.steps} steps")
        return figure_of(case, told, wall)


def least_processor_times(builds, case, repeat):
    """Nanoseconds of processor time per cell or particle and step, of all ranks, by build.

    The difference of a run and one with a third of its steps, each the least of several; builds
    take turns. Of one step or two: the whole run.
    """
    few = case.steps // 3
    least = [{steps: float("inf") for steps in (few, case.steps) if steps} for _ in builds]
    updates = {0: 0}
    for _ in range(repeat):
        for slot, build in zip(least, builds):
            for steps in slot:
                seconds, updates[steps] = processor_time(build, case, steps)
                slot[steps] = min(slot[steps], seconds)
    work = updates[case.steps] - updates[few]
    return [1e9 * (slot[case.steps] - slot.get(few, 0)) / work for slot in least]


def processor_time(build, case, steps):
    """Processor seconds of a whole run, and its updates of cells or particles."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        if SUITE:
            pathlib.Path(folder, "inputs").symlink_to(pathlib.Path(SUITE, "inputs").resolve())
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(run_command(build, case, report, steps), capture_output=True,
                              text=True, cwd=folder)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"bench: '{case.name}' failed ({done.returncode}):\n{done.stderr[-2000:]}")
        told = json.loads(report.read_text())
        by = "particle_updates" if case.unit == "ns/particle/step" else "cell_updates"
        return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, told[by]


def figure_of(case, told, wall):
    """What the unit of a case says of its report."""
    if case.unit == "ms":
        return 1e3 * wall
    if case.unit == "share of regrids":
        return told["regrid_s"] / told["stepping_s"]
    if case.unit == "steps a regrid":
        return told["regrid_s"] / max(told["regrids"], 1) / (told["stepping_s"] / told["steps"])
    if case.unit == "share of balance":
        return told["balance_s"] / told["stepping_s"]
    if case.unit == "ns/cell updated":  # what slept is not counted
        return 1e9 * told["stepping_s"] / (told["cell_updates"] - told["updates_asleep"])
    if case.unit == "ns/particle/step":
        return told["ns_per_particle_step"]
    if case.unit == "MiB":  # the peaks of all ranks together
        return told["peak_memory_bytes"] / 2**20
    if case.unit in ("collectives/step", "kB of collectives/step", "kB sent/step"):
        return messages_of(case, told)
    return told["ns_per_cell_step"]


def messages_of(case, told):
    """Calls or bytes of rank 0 in collectives, or bytes that all ranks send to single others."""
    kinds = told.get("messages", {})  # builds before these were counted tell none
    steps = told["steps"]
    if case.unit == "kB sent/step":
        return kinds.get("sends", {}).get("bytes", 0) / steps / 1e3
    what, scale = ("calls", 1) if case.unit == "collectives/step" else ("bytes", 1e3)
    return sum(n[what] for kind, n in kinds.items() if kind != "sends") / steps / scale


def calibrate(build):
    done = subprocess.run(["taskset", "-c", ONE_CORE, str(build.bin / "sluice_calibration")],
                          capture_output=True, text=True, check=True)
    return float(done.stdout)


def median_runs(builds, cases, repeat):
    """Per build: medians by case name; and all calibration times. Builds take turns."""
    times = [{case.name: [] for case in cases} for _ in builds]
    calibrations = [calibrate(builds[0])]
    for case in cases:
        for _ in range(1 if case.long else repeat):
            calibrations.append(calibrate(builds[0]))
            for slot, build in zip(times, builds):
                slot[case.name].append(run_once(build, case))
        told = [f"{statistics.median(slot[case.name]):.2f} "
                f"(spread {100 * spread(slot[case.name]):.0f} %)" for slot in times]
        print(f"   {case.name}: " + "  ".join(told), flush=True)
    medians = [{name: statistics.median(values) for name, values in slot.items()}
               for slot in times]
    return medians, calibrations


def program_figures(build, programs):
    """The figure that each program of a build prints, by case name."""
    figures = {}
    for case in programs:
        on_ranks = ["mpirun", "-np", str(case.ranks)] if case.ranks > 1 else []
        done = subprocess.run(["taskset", "-c", TWO_CORES if on_ranks else ONE_CORE, *on_ranks,
                               str(build.bin / case.program), *case.arguments],
                              capture_output=True, text=True)
        figures[case.name] = float(re.search(case.unit + " ([0-9.]+)", done.stdout).group(1))
    return figures


def kernel_figures(build, patterns):
    """Medians (ns) of the google-benchmark programs *_bench of a build, by their names."""
    figures = {}
    own = {case.program for case in CASES if isinstance(case, Program)}
    for program in sorted(build.bin.glob("*_bench")):
        if program.name in own:
            continue
        done = subprocess.run(
            ["taskset", "-c", ONE_CORE, str(program), "--benchmark_format=json",
             "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true"],
            capture_output=True, text=True, check=True)
        for row in json.loads(done.stdout)["benchmarks"]:
            name = row.get("run_name", row["name"])
            if row.get("aggregate_name") != "median":
                continue
            if patterns and not any(p in name for p in patterns):
                continue
            per_item = row.get("items_per_second")
            figures[name] = 1e9 / per_item if per_item else row["real_time"]
    return figures


def build_portable(root):
    """The build without AVX-512, which valgrind does not know."""
    for command in (["cmake", "--preset", "portable"],
                    ["cmake", "--build", "--preset", "portable", "--target", "sluice"]):
        done = subprocess.run(command, cwd=root, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"bench: {' '.join(command)} failed:\n{done.stdout[-3000:]}")
    return Build(root, "portable")


def count_instructions(build, case, few=4, many=8):
    """Instructions per cell and step: the difference of two runs of different length."""
    first, _ = instruction_total(build, case, few)
    second, cells = instruction_total(build, case, many)
    return (second - first) / (cells * (many - few))


def instruction_total(build, case, steps):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        valgrind = ("valgrind", "--tool=cachegrind", "--cache-sim=no",
                    f"--cachegrind-out-file={folder}/counts")
        done = subprocess.run(run_command(build, case, report, steps, valgrind),
                              capture_output=True, text=True, cwd=folder,
                              env=dict(os.environ, TBB_NUM_THREADS="1"))
        found = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
        if done.returncode != 0 or not found:
            sys.exit(f"bench: valgrind failed on '{case.name}':\n{done.stderr[-2000:]}")
        return int(found.group(1).replace(",", "")), json.loads(report.read_text())["cells"]
