// What this folder needs of the constitutive models: the tag, and the law that it describes.
#pragma once
#include <memory>
#include <vector>

#include "framework/deck/schema.hpp"
#include "mpm/material/material.hpp"

namespace sluice::mpm {

TagSpec constitutive_model_tag();

// The law of a <material>; nullptr: a fault says why.
std::shared_ptr<const Material> read_law(const DeckNode& material,
                                         const MaterialConstants& constants,
                                         std::vector<Fault>& faults);

// Whether the material's law says that it is rigid.
bool has_rigid_law(const DeckNode& material);

}  // namespace sluice::mpm
