#!/usr/bin/env bash
# the accuracy studies of solids, explicit, implicit and with fluids, LADDER_REPEAT (3) runs each
"$PYTHON" "$SLUICE_ROOT/tools/verify/ladders.py" --root "$SLUICE_ROOT" --sluice "$SLUICE" \
  --folder "$PART_DIR" --group solids --repeat "${LADDER_REPEAT:-3}"
