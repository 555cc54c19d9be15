#include "mpm/deck/material_law.hpp"

#include "mpm/material/materials.hpp"

namespace sluice::mpm {

std::vector<TagSpec> law_tags() {
  std::vector<TagSpec> tags = {constitutive_model_tag()};
  for (TagSpec& tag : failure_tags()) tags.push_back(std::move(tag));
  return tags;
}

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
