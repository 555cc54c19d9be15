#!/usr/bin/env bash
# what ./dev test leaves out: every deck in every way, mirrored, on ranks; the full studies
status=0
run_tests release --full-only || status=$?
echo "RESULT: $(tests_told release)"
exit "$status"
