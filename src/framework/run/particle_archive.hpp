// Which labels of particles can be saved.
#pragma once
#include <vector>

#include "framework/run/particle_method.hpp"

namespace sluice {

// Position, id and attributes of all kinds.
std::vector<Label> savable_labels(const ParticleMethod& method);

}  // namespace sluice
