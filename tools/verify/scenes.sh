#!/usr/bin/env bash
# 1,500 random scenes of fluids and solids, on levels too; each must keep what is conserved
"$PYTHON" "$SLUICE_ROOT/tools/verify/scenes.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --first "${SCENES_FIRST:-0}" --count "${SCENES:-1500}"
