# Configure, build, test, lint one CMake preset. Only one ./dev builds a preset at a time.

cores() { nproc; }

# configure_preset PRESET [CMAKE OPTIONS...]
configure_preset() {
  local preset=$1
  shift
  (cd "$SLUICE_ROOT" &&
    logged "configure_$preset" "configuring $preset" cmake --preset "$preset" "$@") ||
    fail 3 "CMake could not configure the preset '$preset'"
}

# with_lock PRESET COMMAND...: two ./dev at once wait for one another.
with_lock() {
  local preset=$1
  shift
  mkdir -p "$SLUICE_ROOT/build"
  exec {lock}>"$SLUICE_ROOT/build/.$preset.lock"
  if ! flock -n "$lock"; then
    say "another ./dev builds $preset; waiting for it"
    flock "$lock"
  fi
  "$@"
  exec {lock}>&-
}

# build_preset PRESET [TARGETS...]
build_preset() { with_lock "$1" build_preset_locked "$@"; }

build_preset_locked() {
  local preset=$1 targets=()
  shift
  (($# > 0)) && targets=(--target "$@")
  [[ -f $SLUICE_ROOT/build/$preset/build.ninja ]] || configure_preset "$preset"
  (cd "$SLUICE_ROOT" &&
    build_with_progress "$preset" cmake --build --preset "$preset" -j "$(cores)" "${targets[@]}") ||
    fail 1 "the build of '$preset' failed"
}

# build_with_progress PRESET COMMAND...: ninja's [n/m] as a progress line, all else in the log.
build_with_progress() {
  local preset=$1 start=$SECONDS status=0
  local log=$SLUICE_LOGS/build_$preset.log
  shift
  mkdir -p "$SLUICE_LOGS"
  "$@" 2>&1 </dev/null | tee "$log" | build_ticker "$preset" || status=${PIPESTATUS[0]}
  if ((status != 0)); then
    show_errors "$log"
    printf 'dev: the whole output is in %s\n' "${log#"$SLUICE_ROOT/"}" >&2
    return "$status"
  fi
  say "built $preset ($((SECONDS - start)) s)"
}

# On a terminal one line that moves; else a line every half minute.
build_ticker() {
  local line moving=0 last=$SECONDS
  [[ -t 1 ]] && moving=1
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    if ((moving)); then
      printf '\r== building %s: %s of %s ' "$1" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
    elif ((SECONDS - last >= 30)); then
      last=$SECONDS
      say "building $1: ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
    fi
  done
  ((moving)) && printf '\r\033[K'
  return 0
}

# run_tests PRESET [ARGS...]: tools/test/run_tests.py, its last line the count. Permission tests run
# as a user without rights: when we are root, SLUICE_UNPRIVILEGED holds the command that drops them.
run_tests() {
  local preset=$1 status=0
  local log=$SLUICE_LOGS/test_$preset.log
  shift
  mkdir -p "$SLUICE_LOGS"
  if ((EUID == 0)) && command -v setpriv >/dev/null; then
    export SLUICE_UNPRIVILEGED="setpriv --reuid=65534 --regid=65534 --clear-groups"
  fi
  (cd "$SLUICE_ROOT" && "$PYTHON" -B tools/test/run_tests.py --build "build/$preset" \
    --log "$log" -j "$(cores)" "$@" </dev/null) || status=$?
  return "$status"
}

# tests_told PRESET: the count of the last run, as run_tests ended it.
tests_told() { tail -1 "$SLUICE_LOGS/test_$1.log"; }

# run_clang_tidy [FILES...]: all sources of src/ and regression/ when none is named.
run_clang_tidy() {
  local files=("$@")
  if (($# == 0)); then
    mapfile -t files < <(cd "$SLUICE_ROOT" && git ls-files 'src/*.cpp' 'regression/*.cpp')
  fi
  logged clang_tidy "clang-tidy over ${#files[@]} files" tidy_files "${files[@]}" ||
    fail 1 "clang-tidy found faults"
}

# The compile database holds g++'s options; clang-16 does not know all of them.
tidy_files() {
  cd "$SLUICE_ROOT"
  printf '%s\0' "$@" | xargs -0 -n 4 -P "$(cores)" clang-tidy-16 -p build/lint --quiet \
    --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument
}

# write_reference FILE OPTION: a generated page of docs/, replaced only when it could be made.
write_reference() {
  local page=$SLUICE_ROOT/docs/$1 fresh=$SLUICE_ROOT/build/$1
  "$SLUICE_ROOT/build/release/bin/sluice" help "$2" >"$fresh" ||
    fail 1 "docs: sluice help $2 failed; docs/$1 is left as it was"
  mv "$fresh" "$page"
  say "wrote docs/$1"
}
