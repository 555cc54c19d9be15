#!/usr/bin/env bash
# 120 runs killed at random moments, in part one rank of several, and restarted: the same bits
status=0 told=()
kill_runs_of() {  # deck, kills, steps, settings
  local name
  name=$(basename "$1" .ups)$([[ " ${*:4} " != *" --ranks "* ]] || echo _on_ranks)
  "$PYTHON" "$SLUICE_ROOT/tools/verify/kills.py" --sluice "$SLUICE" --folder "$PART_DIR/$name" \
    --deck "$SLUICE_ROOT/inputs/$1" --kills "$2" --steps "$3" "${@:4}" | tee "$name.told" ||
    status=1
  told+=("$(sed -n 's/^RESULT: //p' "$name.told")")
}
kill_runs_of ice/blast_2d.ups "${KILLS:-40}" 300 --set "Grid/Level/Box/resolution=[128,128,1]"
kill_runs_of ice/amr_explosion.ups "${KILLS:-20}" 60
kill_runs_of mpm/colliding_disks.ups "${KILLS:-20}" 400
kill_runs_of mpmice/shock_over_foam.ups "${KILLS:-20}" 60
kill_runs_of mpmice/shock_over_foam.ups "${KILLS:-10}" 300 --ranks 3
kill_runs_of mpmice/burning_bar_across_side.ups "${KILLS:-10}" 1000 --ranks 3
echo "RESULT: $(IFS=';'; echo "${told[*]}")"
exit "$status"
