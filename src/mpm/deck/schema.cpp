// The tags of solids.
#include "mpm/deck/schema.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "mpm/deck/implicit.hpp"
#include "mpm/deck/material_law.hpp"
#include "mpm/deck/pore_water.hpp"

namespace sluice::mpm {
namespace {

std::string component_of(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  return component == nullptr ? "" : component->attribute("type").value_or("");
}

constexpr std::string_view solids_alone[] = {"mpm",  "amrmpm",   "rmpm", "rigidmpm", "sfmpm",
                                             "smpm", "shellmpm", "impm", "shmpm",    "switcher"};
constexpr std::string_view with_fluid[] = {"mpmice", "rmpmice", "rigidmpmice", "smpmice",
                                           "shellmpmice"};

// In any spelling.
template <std::size_t n>
bool is_one_of(std::string type, const std::string_view (&list)[n]) {
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(std::begin(list), std::end(list), type) != std::end(list);
}

}  // namespace

bool runs_mpm(const DeckNode& root) {
  return is_one_of(component_of(root), solids_alone);
}

bool runs_single_field(const DeckNode& root) {
  constexpr std::string_view names[] = {"sfmpm"};
  return is_one_of(component_of(root), names);
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
  schema.add(tag("MaterialProperties", "the materials and their interaction")
                 .child(tag("MPM", "materials of solids")
                            .with_children({material_tag(), contact_tag(), thermal_contact_tag(),
                                            diffusion_interface_tag(), cohesive_zone_tag()})));
  schema.add(loads_tag());
  schema.add(tag("InitialConditions", "accepted without effect: empty blocks of old decks")
                 .child(tag("MPM", "accepted without effect")));
  schema.rewrites.emplace_back(read_old_words);
  schema.rewrites.emplace_back(drop_stray_blocks);
  schema.rewrites.emplace_back(drop_stray_flags);
  schema.rewrites.emplace_back(drop_stray_state);
  schema.rewrites.emplace_back(rename_new_labels);
  schema.rules.emplace_back(check_solid_blocks);
  schema.rules.emplace_back(check_flags);
  schema.rules.emplace_back(check_transfer);
  schema.rules.emplace_back(check_implicit);
  schema.rules.emplace_back(check_pore_water);
  schema.rules.emplace_back(check_solid_materials);
  schema.rules.emplace_back(check_contacts);
  schema.rules.emplace_back(check_cohesive_zones);
  schema.rules.emplace_back(check_grains);
  schema.rules.emplace_back(check_loads);
  schema.rules.emplace_back(check_solid_faces);
}

}  // namespace sluice::mpm
