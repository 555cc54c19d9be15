#!/usr/bin/env bash
# unit tests, each deck of the property tests once, under address and undefined-behaviour sanitizers
# presets: sanitize
status=0 told=()
# Open MPI, libxml2 and HDF5 keep memory until the end of the process: leaks are not counted here.
under_sanitizers() {
  ASAN_OPTIONS=detect_leaks=0:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1 \
    run_tests sanitize --timeout 900 "$@" || status=$?
  told+=("$(tests_told sanitize)")
}
# Left out, as they take hours here: long runs and convergence studies, and decks mirrored and on
# ranks and boxes.
under_sanitizers -LE 'lint|tools|verification|properties'
under_sanitizers --full -L properties -R 'AfterARestart|RandomScene'
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
