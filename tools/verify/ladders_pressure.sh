#!/usr/bin/env bash
# the accuracy studies with the pressure solve, LADDER_REPEAT (3) runs each: docs/accuracy.md
"$PYTHON" "$SLUICE_ROOT/tools/verify/ladders.py" --root "$SLUICE_ROOT" --sluice "$SLUICE" \
  --folder "$PART_DIR" --group pressure --repeat "${LADDER_REPEAT:-3}"
