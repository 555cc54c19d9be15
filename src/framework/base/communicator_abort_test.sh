#!/bin/sh
# One of three ranks aborts with status 3: the launcher must end at once with that status, and the
# reason must be told exactly once. Usage: communicator_abort_test.sh LAUNCHER... TEST_EXECUTABLE
output=$("$@" --gtest_also_run_disabled_tests \
  --gtest_filter=Communicator.DISABLED_one_rank_aborts 2>&1)
status=$?
echo "$output"
test "$status" -eq 3 || { echo "exit status $status, expected 3"; exit 1; }
told=$(echo "$output" | grep -c 'the disk of rank 1 is full')
test "$told" -eq 1 || { echo "the reason was told $told times, expected once"; exit 1; }
