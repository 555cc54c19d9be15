// What a step sums for the books of a run: exact sums, over all ranks.
#pragma once

namespace sluice::peridynamics {

struct StepSums {
  enum Index {
    // Impulse of forces from outside (gravity, loads) and of sides with images, kg m/s.
    force_x,
    force_y,
    force_z,
    side_x,
    side_y,
    side_z,
    work,    // of forces from outside, J
    drag,    // what damping took, J
    broken,  // elastic energy of bonds that broke, J
    bonds,   // that broke, each counted once
    count
  };
};

}  // namespace sluice::peridynamics
