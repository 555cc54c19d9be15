#!/usr/bin/env bash
# every deck of inputs/, and of the public suite those that must run where SLUICE_DECKS names it
exec "$PYTHON" "$SLUICE_ROOT/tools/verify/decks.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --inputs "$SLUICE_ROOT/inputs" ${SLUICE_DECKS:+--suite "$SLUICE_DECKS"}
