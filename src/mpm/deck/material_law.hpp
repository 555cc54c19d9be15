// What this folder needs of the constitutive models: the tags, and the law that they describe.
#pragma once
#include <memory>
#include <vector>

#include "framework/deck/schema.hpp"
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

// <constitutive_model> and what else of a <material> belongs to its law.
std::vector<TagSpec> law_tags();
// The law of a <material>; nullptr: a fault says why.
std::shared_ptr<const Material> read_law(const DeckNode& material,
                                         const MaterialConstants& constants,
                                         std::vector<Fault>& faults);

// Whether the material's law says that it is rigid.
bool has_rigid_law(const DeckNode& material);

}  // namespace sluice::mpm
