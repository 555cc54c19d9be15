#!/usr/bin/env bash
# seconds of each test of ./dev test, one after the other; none may take more than five
status=0
run_tests release -j 1 --times "$PART_DIR/times.json" || status=$?
"$PYTHON" -B "$SLUICE_ROOT/tools/test/costs.py" "$PART_DIR/times.json" \
  --calibration "$SLUICE_ROOT/build/release/bin/sluice_calibration" || status=$?
exit "$status"
