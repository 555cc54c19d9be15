#!/usr/bin/env bash
# Installs a build into an empty folder and uses what lies there: version, a deck, the Python tools.
# usage: test_install.sh BUILD_FOLDER
set -euo pipefail
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" >"$prefix/install.log" || {
  cat "$prefix/install.log"
  exit 1
}
"$prefix/bin/sluice" --version | grep -E '^sluice [0-9]+\.[0-9]+\.[0-9]+ \(.+\)$'
"$prefix/bin/sluice" check "$prefix/share/sluice/inputs/ice/shock_tube.ups"
[[ -f $prefix/share/doc/sluice/user_guide.md ]]
# The public suite's tools are links to the command.
status=0
"$prefix/bin/puda" -timesteps "$prefix/nosuch.uda" 2>"$prefix/said" || status=$?
[[ $status == 1 ]] && grep -q "^puda: error: cannot open archive" "$prefix/said"
# The tools are found: the fault is the missing archive (2), not missing tools (3).
status=0
"$prefix/bin/sluice" plot "$prefix/nosuch.uda" --exact none || status=$?
[[ $status == 2 ]]
