# ./dev run DECK [ARGS]: set up, build, run, draw.

# option_value NAME ARGS...: the value of an option written `NAME VALUE` or `NAME=VALUE`.
option_value() {
  local name=$1
  shift
  while (($# > 0)); do
    case $1 in
      "$name") echo "${2:-}"; return ;;
      "$name"=*) echo "${1#*=}"; return ;;
    esac
    shift
  done
}

command_run() {
  (($# > 0)) || fail 2 "run: give a deck, for example ./dev run inputs/ice/shock_tube.ups"
  local deck=$1 report status=0 sluice=$SLUICE_ROOT/build/release/bin/sluice
  [[ -f $deck ]] || fail 2 "run: there is no file '$deck'; our decks are under inputs/"
  shift
  install_packages core
  build_preset release sluice

  report=$(option_value --json "$@")
  local json=()
  if [[ -z $report ]]; then
    report=$SLUICE_ROOT/build/last_run.json
    json=(--json "$report")
  fi
  rm -f "$report"
  say "sluice run $deck $*"
  "$sluice" run "$deck" "${json[@]}" "$@" || status=$?
  ((status == 0)) || fail "$status" "the run ended with status $status"
  draw_run "$sluice" "$report"
}

# draw_run SLUICE REPORT: names the archive and a picture of it, drawn inside the archive's folder.
draw_run() {
  local archive picture
  archive=$("$PYTHON" -c 'import json, sys
print(json.load(open(sys.argv[1])).get("archive") or "")' "$2") ||
    fail 3 "the run's report $2 cannot be read"
  if [[ -z $archive ]]; then
    say "no archive was written"
    return 0
  fi
  picture=$archive/picture.png
  "$1" plot "$archive" -o "$picture" || fail $? "the picture could not be drawn"
  say "archive: $archive"
  say "picture: $picture"
}
