#!/usr/bin/env bash
# every deck of inputs/, and of the public suite where SLUICE_DECKS names it, run as it stands
[[ -z ${SLUICE_DECKS:-} ]] ||
  "$PYTHON" "$SLUICE_ROOT/tools/verify/suite_decks.py" --sluice "$SLUICE" \
    --check amr ice mpm impm mpmice
"$PYTHON" "$SLUICE_ROOT/tools/verify/decks.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --inputs "$SLUICE_ROOT/inputs" ${SLUICE_DECKS:+--suite "$SLUICE_DECKS"}
