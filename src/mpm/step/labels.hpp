// Names of what particles carry, as decks save it.
#pragma once
#include <string>

#include "framework/field/label.hpp"
#include "mpm/transfer/particle_shape.hpp"

namespace sluice::mpm {

struct SolidLabels {
  Label velocity, acceleration, mass, volume_0, volume, F, stress, energy, temperature,
      concentration, affine, spin, half, size, displacement, colour, marks, given_force, normal,
      outside_force, viscous, lost_energy, lost_heat, open_energy, loss_temperature, viscous_heat,
      reference, scale_factor, heat_source, heating, rate_of_format, place_of_format, outer, split;
  std::array<Label, max_corners> corner;
  Label filled;
  Label surface_temperature, surface_gradient;
  Label flame_kind, flame_come, flame_time, flame_way;
  Label water_mass, water_velocity, pore_pressure, filtered_pressure;
};
const SolidLabels& solid_labels();
// Does a constitutive model, damage, heating or another method of the format give particles this
// label in some scenes.
bool is_label_of_laws(const std::string& name);

}  // namespace sluice::mpm
