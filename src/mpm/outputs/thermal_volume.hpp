// p.JThermal: the volume that a particle would have by its temperature alone, over that at rest.
#pragma once
#include "framework/run/component/particle_method.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// J_T = (1 + alpha_t (T - T_room))^3.
DerivedAttribute thermal_volume_of(const Columns& columns, const MaterialConstants& constants);

}  // namespace sluice::mpm
