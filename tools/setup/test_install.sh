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
# A deck of one's own, a law with its example, completion, and the man page.
"$prefix/bin/sluice" new "$prefix/mine" && "$prefix/bin/sluice" check "$prefix/mine.ups"
"$prefix/bin/sluice" help Tillotson | grep -q "<A>75.2e9</A>"
bash -c "source $prefix/share/bash-completion/completions/sluice
  COMP_WORDS=(sluice pl) COMP_CWORD=1; _sluice; [[ \${COMPREPLY[*]} == 'plan plot' ]]"
grep -q 'SS "sluice run"' "$prefix/share/man/man1/sluice.1"
[[ -f $prefix/share/doc/sluice/user_guide.md ]]
# pip installs the tools, from the installation as from the project; without setuptools it is told.
if /usr/bin/python3 -c 'import setuptools, wheel, pip' 2>/dev/null; then
  cp -r "$prefix/share/sluice/tools" "$prefix/tools" # pip leaves a folder build/ there
  /usr/bin/python3 -m pip install --quiet --no-index --no-deps --no-build-isolation \
    --target "$prefix/python" "$prefix/tools"
  (cd / && PYTHONPATH=$prefix/python /usr/bin/python3 -B -c "
import sluice_tools, sluice_tools.archive
assert sluice_tools.__file__.startswith('$prefix/python'), sluice_tools.__file__
try: sluice_tools.open('nosuch.uda')
except sluice_tools.archive.ArchiveError: pass")
  [[ ! -e $prefix/python/sluice_tools/test_archive.py ]]
else
  echo "skipped: pip install of the tools (no pip, setuptools or wheel)"
fi
# The interpreter that is named is taken.
"$prefix/bin/sluice" run "$prefix/share/sluice/inputs/ice/shock_tube.ups" --max-steps 1 --quiet \
  -o "$prefix/tube.uda"
tube=$(find "$prefix/tube.uda" -name run.json -printf '%h\n' | head -1)
plot=("$prefix/bin/sluice" plot "$tube" --exact none -o "$prefix/tube.png")
status=0
export SLUICE_PYTHON=/nosuch/python
"${plot[@]}" || status=$?
[[ $status == 3 ]]
printf '#!/bin/sh\nexec /usr/bin/python3 "$@"\n' >"$prefix/my_python"
chmod +x "$prefix/my_python"
SLUICE_PYTHON=$prefix/my_python
"${plot[@]}"
unset SLUICE_PYTHON
# The public suite's tools are links to the command.
status=0
"$prefix/bin/puda" -timesteps "$prefix/nosuch.uda" 2>"$prefix/said" || status=$?
[[ $status == 1 ]] && grep -q "^puda: error: cannot open archive" "$prefix/said"
# The tools are found without its help.
rm "$prefix/tube.png"
"${plot[@]}"
[[ -s $prefix/tube.png ]]
