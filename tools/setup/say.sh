# How ./dev speaks: one line a step, the whole output of the step in a log file under build/.

SLUICE_LOGS=$SLUICE_ROOT/build/logs
PYTHON=/usr/bin/python3  # Debian's own: the one that Debian's h5py and matplotlib belong to

say() { printf '== %s\n' "$*"; }

# fail STATUS MESSAGE...: the message on standard error, then the end.
fail() {
  local status=$1
  shift
  printf 'dev: %s\n' "$*" >&2
  exit "$status"
}

# logged NAME TEXT COMMAND...: runs COMMAND quietly with its output in build/logs/NAME.log, shows
# TEXT and the seconds it took. When it fails: the errors (or the end of the log), and the status
# is handed on.
logged() {
  local name=$1 text=$2 start=$SECONDS status=0
  local log=$SLUICE_LOGS/$name.log
  shift 2
  mkdir -p "$SLUICE_LOGS"
  printf '== %s ... ' "$text"
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if ((status == 0)); then
    printf 'done (%d s)\n' $((SECONDS - start))
    return 0
  fi
  printf 'FAILED (status %d)\n' "$status"
  show_errors "$log"
  printf 'dev: the whole output is in %s\n' "${log#"$SLUICE_ROOT/"}" >&2
  return "$status"
}

# show_errors LOG: the compiler's errors with a little context if there are any, else the tail.
show_errors() {
  if grep -qE '(error|Error|undefined reference)[: ]' "$1"; then
    grep -nE -A 6 '(error|Error|undefined reference)[: ]' "$1" | head -60 >&2
  else
    tail -30 "$1" >&2
  fi
}
