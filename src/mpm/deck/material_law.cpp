#include "mpm/deck/material_law.hpp"

namespace sluice::mpm {

std::shared_ptr<const Material> read_law(const DeckNode& material,
                                         const MaterialConstants& constants,
                                         std::vector<Fault>& faults) {
  const DeckNode* model = material.child("constitutive_model");
  // The schema has told that it is missing.
  return model == nullptr ? nullptr : make_material(*model, material, constants, faults);
}

bool has_rigid_law(const DeckNode& material) {
  const DeckNode* model = material.child("constitutive_model");
  return model != nullptr && model->attribute("type") == "rigid";
}

}  // namespace sluice::mpm
