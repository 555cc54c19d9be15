// Stands in for src/mpm/material: a law is its type alone, its parameters are set aside unread, and
// none is made.
#include "mpm/deck/material_law.hpp"

#include "mpm/deck/schema.hpp"

namespace sluice::mpm {

std::vector<TagSpec> law_tags() {
  return {tag("constitutive_model", "the law of the stress")
              .once()
              .attribute(attribute("type", "the law").once().text()),
          tag("damage_model", "how particles fail")
              .attribute(attribute("type", "the law").once().text()),
          tag("erosion", "what becomes of particles that have failed")
              .attribute(attribute("algorithm", "which part of the stress they keep")
                             .once()
                             .text())};
}

void prepare_laws(DeckNode& root, std::vector<Fault>& /*faults*/) {
  for (const auto& properties : root.children) {
    if (properties->name != "MaterialProperties" || properties->child("MPM") == nullptr) continue;
    for (const auto& material : properties->child("MPM")->children)
      for (const char* name : {"constitutive_model", "damage_model", "erosion"})
        if (DeckNode* law = material->child(name)) law->children.clear();
  }
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
