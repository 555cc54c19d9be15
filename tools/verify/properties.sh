#!/usr/bin/env bash
# what ./dev test leaves out: every deck in every way, mirrored, on ranks; the full studies
status=0
# The longest, a vortex ring on four grids, takes half of this limit on a quiet machine.
run_tests release --full-only --timeout 600 || status=$?
echo "RESULT: $(tests_told release)"
exit "$status"
