#!/usr/bin/env bash
# 5,000 decks mutated at random: check, plan and 5 steps end with 0, 1 or 2, never silent, in 10 s
roots=("$SLUICE_ROOT")
for suite in "${SLUICE_DECKS:-}" "${SLUICE_VAANGO_DECKS:-}"; do
  [[ -z $suite ]] || roots+=("$suite")
done
"$PYTHON" "$SLUICE_ROOT/tools/verify/mutations.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  --first "${MUTATIONS_FIRST:-0}" --count "${MUTATIONS:-5000}" "${roots[@]}"
