#!/usr/bin/env bash
# error bars and target errors of decks against the true errors of their studies: docs/accuracy.md
"$PYTHON" "$SLUICE_ROOT/tools/verify/bars.py" --root "$SLUICE_ROOT" --sluice "$SLUICE" \
  --folder "$PART_DIR"
