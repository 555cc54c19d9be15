#!/usr/bin/env bash
# the pages of the public suite's decks and of Vaango's, where their folders are named
status=0 told=()
# Lists of suite_decks.py; one that is out of date does not keep the next from its turn.
list_decks() {
  "$PYTHON" "$SLUICE_ROOT/tools/verify/suite_decks.py" --sluice "$SLUICE" --check "$@" |
    tee -a lists.told || status=1
}
if [[ -n ${SLUICE_DECKS:-} ]]; then
  list_decks amr ice mpm impm mpmice suite
else
  told+=("SLUICE_DECKS is not set: the public suite was skipped")
fi
if [[ -n ${SLUICE_VAANGO_DECKS:-} ]]; then
  list_decks vaango
else
  told+=("SLUICE_VAANGO_DECKS is not set: Vaango's suite was skipped")
fi
mapfile -t found < <(sed -n 's/^RESULT: //p' lists.told 2>/dev/null)
told+=("${found[@]}")
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
