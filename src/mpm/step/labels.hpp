// Names of what particles carry, as decks save it.
#pragma once
#include "framework/field/label.hpp"

namespace sluice::mpm {

struct SolidLabels {
  Label velocity, mass, volume_0, volume, F, stress, energy, temperature, affine, half, size,
      displacement, colour, marks, given_force, normal, outside_force, viscous, reference,
      scale_factor, heat_source;
};
const SolidLabels& solid_labels();

}  // namespace sluice::mpm
