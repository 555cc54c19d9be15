// The table of constitutive models: how decks name them, what they ask of a deck, how one is made.
//
// A new model is a file of its own and a row of the table in materials.cpp.
#pragma once
#include <memory>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/schema.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {

const std::vector<MaterialModel>& material_models();

// <constitutive_model>, <damage_model> and <erosion>, the children of a <material>.
TagSpec constitutive_model_tag();
std::vector<TagSpec> failure_tags();

// The law of a material with its damage and erosion. `material` is the element around it, of which
// <damage_model> and <erosion> are read. Null when something is wrong with it, which `faults` then
// tell with their lines; names that the format knows and we do not are refused by name.
std::shared_ptr<const Material> make_material(const DeckNode& constitutive_model,
                                              const DeckNode& material,
                                              const MaterialConstants& constants,
                                              std::vector<Fault>& faults);

}  // namespace sluice::mpm
