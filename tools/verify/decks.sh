#!/usr/bin/env bash
# every deck of inputs/, of the public suite and of Vaango's where their folders are named, as it is
status=0 told=()
list_decks() {  # lists of suite_decks.py
  "$PYTHON" "$SLUICE_ROOT/tools/verify/suite_decks.py" --sluice "$SLUICE" --check "$@" |
    tee -a lists.told
  ((PIPESTATUS[0] == 0)) || status=1
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
"$PYTHON" "$SLUICE_ROOT/tools/verify/decks.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --inputs "$SLUICE_ROOT/inputs" ${SLUICE_DECKS:+--suite "$SLUICE_DECKS"} | tee -a lists.told
((PIPESTATUS[0] == 0)) || status=1
mapfile -t found < <(sed -n 's/^RESULT: //p' lists.told)
told+=("${found[@]}")
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
