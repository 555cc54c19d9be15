// All labels of ICE: what users may save, and the conserved state.
#pragma once
#include <vector>

#include "framework/field/label.hpp"

namespace sluice::ice {

struct Labels {
  // Conserved state, per volume. Components of momentum: the active directions, then carried ones.
  // Several materials: mass, energy and volume of each, one momentum, kept as of material 0.
  Label mass, momentum, energy, volume;
  // Momentum of a material relative to the mixture, where each has a velocity of its own.
  Label slip;
  Label slip_component[3];
  Label momentum_component[3];  // as checkpoints keep them
  // 1 where slopes are used, 0 in cells whose faces are redone at first order.
  Label mask;
  // Semi-implicit steps: work pressure less that of the state; what the solve adds to it in the
  // step; the system of the first pass, and what the last left.
  Label pressure_offset, pressure_increment, pressure_correction;
  Label last_correction, sum_of_corrections;  // as decks save them
  Label matrix_cell, matrix_face[3], right_side, volume_error;
  // Where a finer level begins: means over its faces, in the cell above.
  Label finer_face_velocity[3], finer_face_pressure[3];
  Label work_pressure, interface_pressure;  // X-; its ghosts where a coarser level begins
  // Where solids stand in the fluid: cut_cells/variables.hpp.
  Label solid_fraction, solid_fraction_next, wall_pressure;
  Label covered[3], mean_covered[3], swept[3], solid_face_velocity[3];
  // Where surfaces of solids burn: as saved; as kept while steps are taken.
  struct AtSurfaces {
    Label saved, kept;
  };
  AtSurfaces burning_steady, burning_unsteady, surface_temperature, surface_gradient;
  // Of explosive that burns and detonates (DDT1).
  AtSurfaces detonating, burning, induction_time, count_time;
  Label kept_burned_share, kept_burned_in_step, kept_model_mass;

  // From a state alone.
  Label rho, velocity, temperature, pressure, specific_volume, sound_speed, mach, volume_fraction;
  Label rho_micro, gradient_rho, gradient_temperature, gradient_pressure, gradient_volume_fraction;
  Label divergence_velocity, refine_flag, vorticity, sum_rho, viscosity, eddy_viscosity,
      total_viscosity, specific_heat, gamma;
  Label subgrid_normal, subgrid_shear;
  Label thermal_conductivity, compressibility;
  Label mass_of_cell, momentum_of_cell, energy_of_cell, volume_of_cell;
  Label compressibility_of_cell, compressibility_share;

  // From within a step.
  Label equilibrium_pressure, pressure_change, lagrangian_momentum, lagrangian_energy;
  Label source_pressure, momentum_source, energy_before_exchange, momentum_before_exchange;
  Label lagrangian_mass, lagrangian_volume, volume_source, energy_source, dilation;
  Label lagrangian_velocity, stress_velocity;
  Label lagrangian_heating, temperature_rate, velocity_rate;
  Label face_stress[3], viscous_source, heat_source;
  Label model_mass, model_momentum, model_energy, model_volume;
  Label face_velocity[3], face_velocity_exchanged[3], face_pressure[3];
  Label face_temperature[3], face_volume_fraction[3], face_pressure_gradient[3];

  // Reductions (.dat).
  Label total_mass, total_momentum, total_internal_energy, kinetic_energy;
  Label total_model_mass, total_model_momentum, total_model_energy;
  Label total_mass_exchanged, total_energy_exchanged;

  Label wave_amplitude[5];  // Li1 to Li5, from a state alone

  // Of models that turn one material into another.
  Label burned_share, burned_in_step;
  Label total_mass_burned, total_heat_released;
  Label pressure_passes, pressure_iterations, pressure_residual, largest_volume_error;
};

// Declares them once; later calls return the same.
const Labels& labels();
// All of them; none that models or analyses of some deck bring.
const std::vector<Label>& own_labels();
// Those of cells that follow from the state of one material alone: what criteria of refinement may
// name in any deck.
std::vector<Label> state_functions();

}  // namespace sluice::ice
