#!/usr/bin/env bash
# every extension of docs/adding.md made in a copy of the sources, built and tried
"$PYTHON" -B "$SLUICE_ROOT/tools/verify/adding.py" --root "$SLUICE_ROOT" --folder "$PART_DIR"
