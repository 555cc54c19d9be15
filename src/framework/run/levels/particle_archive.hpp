// Which labels of particles can be saved, and where particles carry them.
#pragma once
#include <vector>

#include "framework/run/component/particle_method.hpp"

namespace sluice {

// Position, id and attributes of all kinds.
std::vector<Label> savable_labels(const ParticleMethod& method);

// Among the columns of an attribute, the one that holds a component of its label.
std::size_t column_of_component(const ParticleAttribute& attribute, int component);

}  // namespace sluice
