# ./dev run DECK [ARGS]: set up, build, run, draw.

command_run() {
  (($# > 0)) || fail 2 "run: give a deck, for example ./dev run inputs/ice/shock_tube.ups"
  local deck=$1
  [[ -f $deck ]] || fail 2 "run: there is no file '$deck'; our decks are under inputs/"
  shift
  install_packages core
  build_preset release sluice
  say "sluice run $deck --plot $*"
  # Its last lines name the archive and the picture.
  exec "$SLUICE_ROOT/build/release/bin/sluice" run "$deck" --plot "$@"
}
