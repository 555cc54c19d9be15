#!/usr/bin/env bash
# the accuracy studies of solids, and of fluid and solids in full, LADDER_REPEAT (3) runs each, into docs/accuracy.md
"$PYTHON" "$SLUICE_ROOT/tools/verify/ladders.py" --root "$SLUICE_ROOT" --sluice "$SLUICE" \
  --folder "$PART_DIR" --group solids --repeat "${LADDER_REPEAT:-3}"
