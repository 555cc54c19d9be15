#!/usr/bin/env bash
# libFuzzer on decks, --set, archives, geometry files, lists: sanitizers, FUZZ_SECONDS (600) each
# The corpus of each target is kept in build/fuzz/corpus and grows from run to run.
install_packages verify
configure_preset fuzz
mapfile -t targets < <(ninja -C "$SLUICE_ROOT/build/fuzz" -t targets all |
  sed -n "s/^\([a-z_]*_fuzz\): phony$/\1/p" | grep -v ^cmake_ | sort -u)
((${#targets[@]} > 0)) || { echo "RESULT: no fuzz target is declared"; exit 1; }
build_preset fuzz "${targets[@]}"
seconds=${FUZZ_SECONDS:-600}
((seconds * ${#targets[@]} <= 3000)) || seconds=$((3000 / ${#targets[@]}))
status=0 told=()
for name in "${targets[@]}"; do
  corpus=$SLUICE_ROOT/build/fuzz/corpus/$name
  mkdir -p "$corpus" "$name.seeds"
  "$PYTHON" "$SLUICE_ROOT/tools/verify/fuzz_seeds.py" "$name" "$SLUICE_ROOT" "$name.seeds"
  say "$name: $seconds s"
  if "$SLUICE_ROOT/build/fuzz/bin/$name" -max_total_time="$seconds" -timeout=10 -max_len=16384 \
    -rss_limit_mb=4096 -print_final_stats=1 "$corpus" "$name.seeds" >"$name.log" 2>&1; then
    inputs=$(sed -n 's/.*number_of_executed_units: *//p' "$name.log")
    told+=("$name: $inputs inputs in $seconds s, no fault, $(find "$corpus" -type f | wc -l) kept")
  else
    status=1
    told+=("$name: FAILED, the input is kept in ${PART_DIR#"$SLUICE_ROOT/"}")
    tail -40 "$name.log"
  fi
done
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
