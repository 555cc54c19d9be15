#!/usr/bin/env bash
# every command of README.md and docs/: exit status and message as recorded
install_packages test
"$PYTHON" "$SLUICE_ROOT/tools/verify/commands.py" --sluice "$SLUICE" --root "$SLUICE_ROOT" \
  --folder "$PART_DIR/pages"
