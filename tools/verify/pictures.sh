#!/usr/bin/env bash
# default pictures of five decks: each material covers its share of the plane within 5 %, in pixels
[[ -n ${SLUICE_DECKS:-} ]] || echo "skipped: decks of the public suite (SLUICE_DECKS is not set)"
shares=$PART_DIR/shares.txt
"$PYTHON" "$SLUICE_ROOT/tools/verify/pictures.py" --sluice "$SLUICE" --folder "$PART_DIR" |
  tee "$shares"
worst=$(sed -n 's/.* off *\([-+][0-9.]*\) %$/\1/p' "$shares" | tr -d '+-' | sort -g | tail -1)
echo "RESULT: $(grep -c ' drawn ' "$shares") materials, the worst off by $worst %"
