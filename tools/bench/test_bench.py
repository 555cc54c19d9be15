"""Tests of the bench frame with a stand-in for the sluice command."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allocations  # noqa: E402
import bench  # noqa: E402
import compile_times  # noqa: E402
import measure  # noqa: E402
import table  # noqa: E402
from cases import CASES, Ratio, Run  # noqa: E402

STAND_IN = """#!/bin/sh
while [ "$1" != --json ]; do shift; done
echo '{"steps": 10, "cells": 100, "ns_per_cell_step": 42.0}' > "$2"
"""


class Frame(unittest.TestCase):
    def test_ratio_case_brings_its_runs(self):
        names = [case.name for case in bench.wanted(CASES, ["speed-up of 2 threads"])]
        self.assertEqual(names, ["3-D, 96^3", "3-D, 96^3, 2 threads", "speed-up of 2 threads"])

    def test_long_cases_and_their_ratios_only_when_asked_for(self):
        cases = [Run("a", "d", 1), Run("b", "d", 1, long=True), Ratio("a/b", "a", "b")]
        self.assertEqual(bench.without_long(cases), cases[:1])
        self.assertEqual(bench.wanted(cases, []), cases)

    def test_figures_of_ratios(self):
        cases = [Run("a", "d", 1), Run("b", "d", 1), Ratio("a/b", "a", "b")]
        self.assertEqual(bench.figures_of(cases, {"a": 6.0, "b": 2.0})["a/b"], 3.0)

    def test_limits_upper_and_lower(self):
        run, ratio = Run("a", "d", 1, limit=30), Ratio("r", "a", "b", 1.85, at_least=True)
        self.assertEqual([table.verdict(run, 30.0), table.verdict(run, 30.1)], ["ok", "OVER"])
        self.assertEqual([table.verdict(ratio, 1.85), table.verdict(ratio, 1.8)], ["ok", "UNDER"])

    def test_rows_name_the_change(self):
        rows = list(table.rows([Run("a", "d", 1, limit=30)], {"a": 22.0},
                               {"figures": {"a": 20.0}}, 0.11))
        self.assertEqual(rows, [["a", "22.00", "200", "20.00", "+10.0 %", "*", "30", "ok"]])

    def test_run_reads_the_report(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            program = root / "build/release/bin/sluice"
            program.parent.mkdir(parents=True)
            program.write_text(STAND_IN)
            program.chmod(0o755)
            build = measure.Build(root, "release")
            self.assertEqual(measure.run_once(build, Run("a", "deck.ups", 10)), 42.0)

    def test_processor_time_is_a_difference_of_minima(self):
        case, builds = Run("a", "d", 30), ["one", "two"]
        seconds = iter([3.0, 7.0, 2.5, 6.5, 2.0, 8.0, 3.0, 4.5, 9.0])  # few, many; one, two; twice
        real, measure.processor_time = measure.processor_time, (
            lambda build, case, steps: (next(seconds), 1000 * steps))
        try:
            figures = measure.least_processor_times(builds, case, 2)
            whole_run = measure.least_processor_times(["one"], Run("a", "d", 2), 1)
        finally:
            measure.processor_time = real
        self.assertEqual(figures, [1e9 * 5.0 / 20000, 1e9 * 2.0 / 20000])
        self.assertEqual(whole_run, [1e9 * 9.0 / 2000])

    def test_shares_of_a_report(self):
        told = {"regrid_s": 2.0, "regrids": 4, "balance_s": 1.0, "stepping_s": 50.0, "steps": 10}
        figures = [measure.figure_of(Run("a", "d", 0, unit=unit), told, 7.0)
                   for unit in ("share of regrids", "steps a regrid", "share of balance", "ms")]
        self.assertEqual(figures, [0.04, 0.1, 0.02, 7000.0])

    def test_messages_and_memory_of_a_report(self):
        told = {"steps": 10, "peak_memory_bytes": 3 * 2**20,
                "messages": {"reductions": {"calls": 20, "bytes": 5000},
                             "barriers": {"calls": 10, "bytes": 0},
                             "sends": {"calls": 40, "bytes": 80000}}}
        figures = [measure.figure_of(Run("a", "d", 0, unit=unit), told, 7.0)
                   for unit in ("MiB", "collectives/step", "kB of collectives/step",
                                "kB sent/step")]
        self.assertEqual(figures, [3.0, 3.0, 0.5, 8.0])

    def test_cases_that_cannot_be_run_yet_only_by_name(self):
        cases = [Run("a", "d", 1), Run("b", "d", 1, by_name=True)]
        self.assertEqual(bench.wanted(cases, []), cases[:1])
        self.assertEqual(bench.wanted(cases, ["b"]), cases[1:])

    def test_what_slept_is_not_counted_as_updated(self):
        told = {"stepping_s": 1.0, "cell_updates": 5000, "updates_asleep": 3000}
        updated = Run("a", "d", 0, unit="ns/cell updated")
        self.assertEqual(measure.figure_of(updated, told, 7.0), 5e5)

    def test_every_unit_is_known(self):
        units = {"ns/cell/step", "ns/cell updated", "ms", "share of regrids", "steps a regrid",
                 "share of balance", "ns/particle/step", "MiB", "collectives/step",
                 "kB of collectives/step", "kB sent/step"}
        self.assertLessEqual({case.unit for case in CASES if isinstance(case, Run)}, units)

    def test_savings_are_off_unless_asked_for(self):
        build = measure.Build(pathlib.Path("/r"), "release")
        off = measure.run_command(build, Run("a", "d", 5), "r.json", 5)
        self.assertIn("--force-all", off)
        self.assertEqual(off[off.index("--max-steps") + 1], "5")
        self.assertNotIn("--force-all",
                         measure.run_command(build, Run("a", "d", 5, savings=True), "r.json", 5))

    def test_recorded_figures_belong_to_cases(self):
        file = pathlib.Path(bench.RECORDED)
        if not file.exists():
            self.skipTest("nothing recorded yet")
        recorded = json.loads(file.read_text())
        self.assertLessEqual({"figures", "commit", "date", "machine"}, set(recorded))
        self.assertLessEqual(set(recorded["figures"]), {case.name for case in CASES})


class Allocations(unittest.TestCase):
    def test_a_known_number_is_counted(self):
        program = ("import ctypes, sys\nlibc = ctypes.CDLL(None)\n"
                   "for n in range(int(sys.argv[1])):\n    libc.malloc(100000 + 100000 * (n % 2))")
        with tempfile.TemporaryDirectory() as folder:
            library = allocations.build_library(folder)
            few, many = (allocations.counts_of([sys.executable, "-c", program, str(n)], library,
                                               folder) for n in (10, 1010))
        self.assertEqual(allocations.by_step(few, many, 500)[2:], [1.0, 200000.0])
        self.assertGreaterEqual(allocations.by_step(few, many, 500)[0], 2.0)


class CompileTimes(unittest.TestCase):
    def test_sums_by_target_and_the_last_of_an_object(self):
        lines = ["1.5 0.1 2 src/ice/CMakeFiles/ice.dir/ice.cpp.o",
                 "1.0 0.1 2 src/ice/CMakeFiles/ice.dir/ice.cpp.o",
                 "Command exited with non-zero status 1",
                 "4.0 0.1 2 src/ice/CMakeFiles/ice_test.dir/Unity/unity_0_cxx.cxx.o"]
        now = compile_times.seconds_by_target(lines)
        self.assertEqual(now, {"ice": 1.0, "ice_test": 4.0})
        self.assertEqual([row.split() for row in compile_times.table(now, {"ice_test": 8.0})],
                         [["ice_test", "4.0", "8.0"], ["ice", "1.0"], ["program", "1.0"],
                          ["tests", "4.0", "8.0"]])


if __name__ == "__main__":
    unittest.main()
