#!/usr/bin/env bash
# 50 runs killed at random moments and restarted; the end must equal the uninterrupted run's bits
"$PYTHON" "$SLUICE_ROOT/tools/verify/kills.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --deck "$SLUICE_ROOT/inputs/ice/blast_2d.ups" --kills "${KILLS:-50}"
