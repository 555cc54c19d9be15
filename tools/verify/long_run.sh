#!/usr/bin/env bash
# 10^6 steps of a small deck with regrids and outputs: memory stays flat
# Where waves have died down the estimate of errors, a fraction of the range, follows round-off.
"$PYTHON" "$SLUICE_ROOT/tools/verify/long_run.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --deck "$SLUICE_ROOT/inputs/ice/amr_periodic_shocks.ups" --steps "${STEPS:-1000000}" \
  --set 'Grid/Level/Box/resolution=[40,1,1]' --set AMR/ErrorEstimate= \
  --set AMR/ErrorEstimate/@variable=press_CC --set AMR/ErrorEstimate/@tolerance=0.05
