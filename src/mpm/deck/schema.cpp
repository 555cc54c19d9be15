// The tags of solids.
#include "mpm/deck/schema.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "mpm/deck/data_file.hpp"

namespace sluice::mpm {
namespace {

std::string component_of(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  return component == nullptr ? "" : component->attribute("type").value_or("");
}

template <std::size_t n>
bool is_one_of(std::string_view type, const std::array<std::string_view, n>& list) {
  return std::find(list.begin(), list.end(), type) != list.end();
}

constexpr std::array<std::string_view, 9> solids_alone = {
    "mpm", "MPM", "amrmpm", "AMRmpm", "AMRMPM", "rmpm", "rigidmpm", "sfmpm", "SFMPM"};
constexpr std::array<std::string_view, 4> with_fluid = {"mpmice", "MPMICE", "rmpmice",
                                                        "rigidmpmice"};

}  // namespace

bool runs_mpm(const DeckNode& root) {
  return is_one_of(component_of(root), solids_alone);
}

bool runs_solids(const DeckNode& root) {
  return runs_mpm(root) || is_one_of(component_of(root), with_fluid);
}

std::vector<const DeckNode*> mpm_materials(const DeckNode& root) {
  std::vector<const DeckNode*> materials;
  for (const DeckNode* properties : root.all("MaterialProperties")) {
    const DeckNode* mpm = properties->child("MPM");
    if (mpm == nullptr) continue;
    for (const DeckNode* node : mpm->all("material")) materials.push_back(node);
  }
  return materials;
}

void add_mpm_tags(Schema& schema) {
  schema.add(flags_tag());
  schema.add(tag("AMR", "").child(refinement_tag()));
  schema.add(tag("MaterialProperties", "the materials and how they act on each other")
                 .child(tag("MPM", "materials of solids")
                            .with_children({material_tag(), contact_tag(), thermal_contact_tag(),
                                            cohesive_zone_tag()})));
  schema.add(loads_tag());
  schema.rewrites.emplace_back(drop_stray_blocks);
  schema.rewrites.emplace_back(drop_stray_flags);
  schema.rewrites.emplace_back(drop_stray_state);
  schema.rewrites.emplace_back(locate_pieces);
  schema.rules.emplace_back(check_solid_blocks);
  schema.rules.emplace_back(check_flags);
  schema.rules.emplace_back(check_transfer);
  schema.rules.emplace_back(check_solid_materials);
  schema.rules.emplace_back(check_contacts);
  schema.rules.emplace_back(check_loads);
  schema.rules.emplace_back(check_solid_faces);
}

}  // namespace sluice::mpm
