// Where the quantities of a state lie that parabolas give at the edges of cells (parabolas/): those
// at the high edge of a cell come first, then those at its low edge.
#pragma once
#include "ice/step/scheme_options.hpp"

namespace sluice::ice {

// Density, velocity, pressure and, with laws other than that of an ideal gas, internal energy.
struct TracedComponents {
  int velocities = 1;
  bool energy = false;

  static TracedComponents of(const SchemeOptions& o) {
    return {o.grid.components, o.materials.fluid.gamma_law() == nullptr};
  }
  int count() const { return velocities + (energy ? 3 : 2); }
};

}  // namespace sluice::ice
