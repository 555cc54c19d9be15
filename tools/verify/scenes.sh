#!/usr/bin/env bash
# random scenes: 600 of fluids, 300 of solids, 200 of both (some on ranks); what is conserved stays
"$PYTHON" "$SLUICE_ROOT/tools/verify/scenes.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --first "${SCENES_FIRST:-0}" --fluid "${SCENES_FLUID:-600}" --solid "${SCENES_SOLID:-300}" \
  --coupled "${SCENES_COUPLED:-200}"
