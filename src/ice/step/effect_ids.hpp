// Ids of the effects of ICE: places in the list that find_effects() gives (ice.hpp).
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

enum EffectId {
  effect_flow = 0,
  effect_second_order,
  effect_gravity,
  effect_viscosity,
  effect_boundary_budget,
  effect_flux_record,
  effect_saved_intermediates,
  effect_diagnostics,
  effect_conduction,
  effect_equilibration,
  effect_momentum_exchange,
  effect_heat_exchange,
  effect_turbulence,
  effect_scalars,
  effect_driving_force,
  effect_sources,
  effect_reactions,
  effect_tracers,
  effect_pressure_solve,
  effect_shock_shear,
  effect_open_faces,
  effect_solids  // of scenes with solids alone
};

// Whose task the account of forces is.
inline int effect_of_forces(const SchemeOptions& o) {
  return o.forces.driving_on ? effect_driving_force : effect_gravity;
}

}  // namespace sluice::ice
