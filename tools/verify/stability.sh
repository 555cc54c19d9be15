#!/usr/bin/env bash
# every hard case with all values of its sweeps; docs/stability.md and the recorded map
status=0
"$SLUICE" stability --cases "$SLUICE_ROOT/regression/stability" -o "$PART_DIR" \
  --record "$PART_DIR/recorded.json" || status=$?
"$PYTHON" "$SLUICE_ROOT/tools/verify/stability_page.py" --map "$PART_DIR/stability.json" \
  --picture "$PART_DIR/stability.png" --docs "$SLUICE_ROOT/docs"
cp "$PART_DIR/recorded.json" "$SLUICE_ROOT/regression/stability/recorded.json"
exit "$status"
