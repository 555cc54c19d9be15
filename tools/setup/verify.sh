# ./dev verify [--limit MINUTES] [PART...]: checks too long for ./dev test. Each part is
# tools/verify/PART.sh, at most 60 minutes on a machine that does nothing else. A part that passed
# is kept for its commit under build/verify/COMMIT and not repeated; every result goes into
# docs/verification.md with commit and date.
#
# A part is run with SLUICE_ROOT, SLUICE (the executable), PYTHON and PART_DIR (an empty folder to
# work in) in its environment, by bash, with these functions. Its last line beginning with
# "RESULT: " is what the table shows. Exit 0 is passed, anything else failed. Presets that its line
# "# presets: NAME..." names are built before, outside of the limit.

PART_LIMIT=3600 # seconds

verify_parts() {
  local file
  for file in "$SLUICE_ROOT"/tools/verify/*.sh; do basename "$file" .sh; done
}

# The commit, with "-changed" when tracked sources differ from it: such results are not kept.
verified_commit() {
  local commit
  commit=$(git -C "$SLUICE_ROOT" rev-parse --short=12 HEAD 2>/dev/null) || commit=unknown
  if [[ -n $(git -C "$SLUICE_ROOT" status --porcelain --untracked-files=no -- \
    . ':!docs/verification.md' ':!docs/accuracy*' ':!docs/stability*' \
    ':!regression/stability/recorded.json' 2>/dev/null) ]]; then
    commit+=-changed
  fi
  echo "$commit"
}

list_verify_parts() {
  local part
  for part in $(verify_parts); do
    printf '%-16s %s\n' "$part" "$(sed -n '2s/^# //p' "$SLUICE_ROOT/tools/verify/$part.sh")"
  done
}

command_verify() {
  local parts=("$@") part failed=()
  case ${1:-} in
    --list) list_verify_parts; return 0 ;;
    -h | --help)
      echo "usage: ./dev verify [--limit MINUTES] [PART...]"
      echo "Each part is stopped after MINUTES (60; more where the machine does other work beside)."
      echo "Without PART all of these:"
      list_verify_parts
      return 0 ;;
    --limit)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] ||
        fail 2 "verify: --limit: found '${2:-nothing}', expected a whole number of minutes"
      PART_LIMIT=$(($2 * 60))
      parts=("${@:3}") ;;
  esac
  ((${#parts[@]} > 0)) || mapfile -t parts < <(verify_parts)
  for part in "${parts[@]}"; do
    [[ -f $SLUICE_ROOT/tools/verify/$part.sh ]] ||
      fail 2 "verify: no part '$part'; there are: $(verify_parts | paste -sd' ')"
  done
  install_packages core
  build_preset release
  for part in "${parts[@]}"; do verify_part "$part" || failed+=("$part"); done
  ((${#failed[@]} == 0)) || fail 1 "failed parts: ${failed[*]}"
  say "all parts passed: ${parts[*]}"
}

# verify_part PART
verify_part() {
  local part=$1 commit folder status=0 start outcome result
  commit=$(verified_commit)
  folder=$SLUICE_ROOT/build/verify/$commit
  if [[ -f $folder/$part.passed && $commit != *-changed ]]; then
    say "$part: passed already at $commit"
    return 0
  fi
  local preset
  for preset in $(sed -n 's/^# presets: //p' "$SLUICE_ROOT/tools/verify/$part.sh"); do
    build_preset "$preset"
  done
  rm -rf "$folder/$part.work" "$folder/$part.passed"
  mkdir -p "$folder/$part.work"
  start=$SECONDS
  say "$part: started (at most $((PART_LIMIT / 60)) minutes; log build/verify/$commit/$part.log)"
  SLUICE=$SLUICE_ROOT/build/release/bin/sluice PYTHON=$PYTHON PART_DIR=$folder/$part.work \
    timeout --kill-after=30 "$PART_LIMIT" bash -euo pipefail -c '
      for part in say packages build; do source "$SLUICE_ROOT/tools/setup/$part.sh"; done
      cd "$PART_DIR"
      source "$SLUICE_ROOT/tools/verify/$0.sh"' "$part" </dev/null 2>&1 |
    tee "$folder/$part.log" || status=${PIPESTATUS[0]}
  result=$(sed -n 's/^RESULT: //p' "$folder/$part.log" | tail -1)
  outcome=failed
  ((status == 124)) && result="stopped at the limit of $PART_LIMIT s; $result"
  if ((status == 0)); then
    outcome=passed
    touch "$folder/$part.passed"
  fi
  "$PYTHON" "$SLUICE_ROOT/tools/verify/record.py" "$SLUICE_ROOT/docs/verification.md" \
    --part "$part" --commit "$commit" --outcome "$outcome" \
    --seconds $((SECONDS - start)) --result "$result"
  say "$part: $outcome"
  return "$status"
}
