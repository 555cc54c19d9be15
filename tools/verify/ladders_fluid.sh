#!/usr/bin/env bash
# studies of explicit fluid, levels and reactions, LADDER_REPEAT (3) runs each: docs/accuracy.md
"$PYTHON" "$SLUICE_ROOT/tools/verify/ladders.py" --root "$SLUICE_ROOT" --sluice "$SLUICE" \
  --folder "$PART_DIR" --group fluid --repeat "${LADDER_REPEAT:-3}"
