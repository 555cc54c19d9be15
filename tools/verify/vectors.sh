#!/usr/bin/env bash
# the compiler's own report: every loop marked for vectors has become one
"$PYTHON" "$SLUICE_ROOT/tools/verify/vectors.py" --root "$SLUICE_ROOT" \
  --build "$SLUICE_ROOT/build/release"
