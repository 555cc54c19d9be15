#!/usr/bin/env bash
# what ./dev test leaves out: every deck in every way, mirrored, on ranks; the full studies
status=0
# A vortex ring on four grids needs more than the 300 s of a case where other work runs beside it.
run_tests release --full-only --timeout 600 || status=$?
echo "RESULT: $(tests_told release)"
exit "$status"
