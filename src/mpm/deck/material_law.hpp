// The law of a <material>.
#pragma once
#include <memory>
#include <vector>

#include "mpm/material/materials.hpp"

namespace sluice::mpm {

// nullptr: a fault says why.
std::shared_ptr<const Material> read_law(const DeckNode& material,
                                         const MaterialConstants& constants,
                                         std::vector<Fault>& faults);

// Whether the material's law says that it is rigid.
bool has_rigid_law(const DeckNode& material);

}  // namespace sluice::mpm
