#!/bin/sh
# How three ranks end: the launcher must return the wanted status, tell the reason exactly once,
# and print no banner. Usage: communicator_end_test.sh LAUNCHER... TEST_EXECUTABLE
run() {
  case=$1
  expected=$2
  shift 2
  output=$("$@" --gtest_filter="CommunicatorEnd.$case" 2>&1)
  status=$?
  echo "$output"
  test "$status" -eq "$expected" || { echo "exit status $status, expected $expected"; exit 1; }
  if echo "$output" | grep -qE 'MPI_ABORT|Primary job'; then
    echo "a banner hides the message"
    exit 1
  fi
}

run one_rank_aborts 3 "$@"
told=$(echo "$output" | grep -c 'the disk of rank 1 is full')
test "$told" -eq 1 || { echo "the reason was told $told times, expected once"; exit 1; }
run all_ranks_exit_together 1 "$@"
