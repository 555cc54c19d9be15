#!/usr/bin/env bash
# all tests under the address and undefined-behaviour sanitizers
build_preset sanitize
status=0
# Open MPI, libxml2 and HDF5 keep memory until the end of the process: leaks are not counted here.
ASAN_OPTIONS=detect_leaks=0:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1 \
  run_tests sanitize -LE 'lint|tools' --timeout 900 || status=$?
summary=$(grep -E 'tests passed' "$SLUICE_LOGS/test_sanitize.log" | tail -1)
echo "RESULT: $summary"
exit "$status"
