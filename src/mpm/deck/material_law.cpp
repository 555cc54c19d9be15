// Stands in for src/mpm/material: any model is described by its type alone, and none is made.
#include "mpm/deck/material_law.hpp"

namespace sluice::mpm {

TagSpec constitutive_model_tag() {
  return tag("constitutive_model", "the law of the stress")
      .once()
      .attribute(attribute("type", "the law").once().text());
}

std::shared_ptr<const Material> read_law(const DeckNode& /*material*/,
                                         const MaterialConstants& /*constants*/,
                                         std::vector<Fault>& /*faults*/) {
  return nullptr;
}

bool has_rigid_law(const DeckNode& material) {
  const DeckNode* model = material.child("constitutive_model");
  return model != nullptr && model->attribute("type") == "rigid";
}

}  // namespace sluice::mpm
