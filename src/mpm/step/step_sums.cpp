#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

void NodeBooks::make_room(std::size_t count) {
  given.resize(count);
  bodies.resize(count);
}

void NodeBooks::merge(const NodeBooks& other) {
  for (std::size_t s = 0; s < sums.size(); ++s) sums[s].merge(other.sums[s]);
  for (std::size_t k = 0; k < other.given.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d) given[k][d].merge(other.given[k][d]);
  for (std::size_t k = 0; k < other.bodies.size(); ++k) bodies[k].merge(other.bodies[k]);
}

}  // namespace sluice::mpm
