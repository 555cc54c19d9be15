#!/usr/bin/env bash
# every accuracy study in full, LADDER_REPEAT (3) runs each: error, order, cost, into docs/accuracy
mapfile -t studies < <(find "$SLUICE_ROOT/regression/accuracy" -name '*.study' | sort)
((${#studies[@]} > 0)) || { echo "RESULT: there is no study"; exit 1; }
mkdir -p "$SLUICE_ROOT/docs/accuracy"
failed=() runs=0
for study in "${studies[@]}"; do
  name=$(basename "$study" .study)
  "$SLUICE" accuracy "$study" -o "$PART_DIR/$name" --repeat "${LADDER_REPEAT:-3}" \
    >"$name.txt" 2>&1 || failed+=("$name")
  done_runs=$(grep -c '^\[' "$name.txt" || true)
  runs=$((runs + done_runs))
  say "$name: $done_runs runs"
  for file in "$PART_DIR/$name/$name".{csv,png}; do
    [[ -f $file ]] && cp "$file" "$SLUICE_ROOT/docs/accuracy/"
  done
done
echo "RESULT: ${#studies[@]} studies, $runs runs${failed:+; with failed runs: ${failed[*]}}"
((${#failed[@]} == 0))
