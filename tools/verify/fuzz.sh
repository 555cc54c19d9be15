#!/usr/bin/env bash
# libFuzzer on decks and archives with sanitizers, FUZZ_SECONDS (600) for each target
install_packages verify
build_preset fuzz
mapfile -t targets < <(find "$SLUICE_ROOT/build/fuzz/bin" -name '*_fuzz' -type f | sort)
((${#targets[@]} > 0)) || { echo "RESULT: no fuzz target was built"; exit 1; }
seconds=${FUZZ_SECONDS:-$((1200 / ${#targets[@]} > 600 ? 600 : 1200 / ${#targets[@]}))}
status=0 told=()
for target in "${targets[@]}"; do
  name=$(basename "$target")
  mkdir -p "$name.corpus"
  seeds=$SLUICE_ROOT/regression/fuzz/$name
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=4096 -print_final_stats=1)
  say "$name: $seconds s"
  if "$target" "${options[@]}" "$name.corpus" $([[ -d $seeds ]] && echo "$seeds") >"$name.log" 2>&1
  then
    told+=("$name: $(sed -n 's/.*number_of_executed_units: *//p' "$name.log") inputs, no crash")
  else
    status=1
    told+=("$name: CRASHED, input kept in ${PART_DIR#"$SLUICE_ROOT/"}")
    tail -40 "$name.log"
  fi
done
IFS=';'
echo "RESULT: ${told[*]}"
exit "$status"
