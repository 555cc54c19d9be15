#!/usr/bin/env bash
# the told distance of ten decks from failing: 0.93 of that factor must hold, 1.07 must not
"$PYTHON" "$SLUICE_ROOT/tools/verify/margins.py" --sluice "$SLUICE" --folder "$PART_DIR" \
  "$SLUICE_ROOT"/inputs/ice/{amr_explosion_quarter,amr_hydrostatic_column,amr_layers_bar}.ups \
  "$SLUICE_ROOT"/inputs/ice/{amr_mass_exchange,amr_periodic_shocks,amr_riemann_2d}.ups \
  "$SLUICE_ROOT"/inputs/ice/{heat_wave,helium_bubble}.ups \
  "$SLUICE_ROOT/inputs/mpm/colliding_disks.ups" "$SLUICE_ROOT/inputs/mpmice/shock_on_wall.ups"
