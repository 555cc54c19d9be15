// Sums of particles' values on nodes, sum q S: up to seven columns at a time, as exact integers. A
// value may have any unit; places x are in m.
#pragma once
#include <span>

#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// Values of one lane: columns are read from the particle that x is read from.
struct ValueLane {
  const double* values = nullptr;
  double unit = 1;  // 2^k for a bound of |values| (scale_for)
};

// Particles begin to end (of one block) into the window: lane l gets sum values_l S.
void add_values_to_window(Basis basis, const TransferGrid& grid,
                          const std::array<const double*, 3>& x, const ParticleShape& shape,
                          std::span<const ValueLane> lanes_of, int begin, int end, Window& window);

}  // namespace sluice::mpm
