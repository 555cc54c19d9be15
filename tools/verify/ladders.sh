#!/usr/bin/env bash
# every accuracy study of regression/accuracy in full: error, order and cost, into docs/accuracy
mapfile -t studies < <(find "$SLUICE_ROOT/regression/accuracy" -name '*.study' | sort)
((${#studies[@]} > 0)) || { echo "RESULT: there is no study"; exit 1; }
mkdir -p "$SLUICE_ROOT/docs/accuracy"
told=()
for study in "${studies[@]}"; do
  name=$(basename "$study" .study)
  say "$name"
  "$SLUICE" accuracy "$study" -o "$PART_DIR/$name" | tee "$name.txt"
  for file in "$PART_DIR/$name"/*.{csv,png}; do
    [[ -f $file ]] && cp "$file" "$SLUICE_ROOT/docs/accuracy/"
  done
  told+=("$name: $(grep -c '^\[' "$name.txt") runs")
done
IFS=';'
echo "RESULT: ${told[*]}"
