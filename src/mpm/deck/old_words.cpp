// Words of older decks of solids that need more than another name: each is moved to where it stands
// today, with one warning.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/deck/rule_tools.hpp"
#include "mpm/deck/implicit.hpp"

namespace sluice::mpm {
namespace {

std::unique_ptr<DeckNode> make_node(const std::string& name, const Location& where,
                                    std::string text = {}) {
  auto node = std::make_unique<DeckNode>();
  node->name = name;
  node->text = std::move(text);
  node->where = where;
  return node;
}

// Calls f for every <material> of solids.
template <class F>
void for_materials(DeckNode& root, F&& f) {
  for (const auto& properties : root.children) {
    DeckNode* mpm = properties->name == "MaterialProperties" ? properties->child("MPM") : nullptr;
    if (mpm == nullptr) continue;
    for (const auto& material : mpm->children)
      if (material->name == "material") f(*material);
  }
}

// Takes a child out of a node; null: there is none.
std::unique_ptr<DeckNode> take(DeckNode& node, std::string_view name) {
  const auto at = std::find_if(node.children.begin(), node.children.end(),
                               [&](const auto& child) { return child->name == name; });
  if (at == node.children.end()) return nullptr;
  std::unique_ptr<DeckNode> taken = std::move(*at);
  node.children.erase(at);
  return taken;
}

// <erosion> of all materials: of each that has none of its own.
void give_erosion(DeckNode& root, DeckNode& flags, std::vector<Fault>& faults) {
  const std::unique_ptr<DeckNode> erosion = take(flags, "erosion");
  if (erosion == nullptr) return;
  if (erosion->attribute("algorithm").value_or("none") == "none") {
    add_warning(faults, erosion->where, "<erosion> in <MPM> is obsolete; dropped",
                "each material has its own <erosion>");
    return;
  }
  add_warning(faults, erosion->where,
              "<erosion> in <MPM> is obsolete; read as <erosion> of each material that has none",
              "each material has its own <erosion>");
  for_materials(root, [&](DeckNode& material) {
    if (material.child("erosion") == nullptr) material.children.push_back(copy_of(*erosion));
  });
}

// Nodes of a particle: 8 are those of linear shape functions, 27 those of gimp.
void read_node_count(DeckNode& flags, std::vector<Fault>& faults) {
  const std::unique_ptr<DeckNode> count = take(flags, "nodes8or27");
  if (count == nullptr) return;
  const bool wide = count->text == "27" && flags.child("interpolator") == nullptr;
  if (count->text != "8" && count->text != "27")
    add_error(faults, count->where,
              fmt::format("<nodes8or27>: '{}' is neither 8 nor 27", count->text),
              "write <interpolator>linear</interpolator> or gimp in its place");
  else
    add_warning(faults, count->where,
                wide ? "<nodes8or27> 27 is obsolete; read as <interpolator> gimp"
                     : "<nodes8or27> is obsolete; dropped",
                "<interpolator> determines it");
  if (wide) flags.children.push_back(make_node("interpolator", count->where, "gimp"));
}

// Solids grow with their temperature by a coefficient of their own.
void read_expansion(DeckNode& root, DeckNode& flags, std::vector<Fault>& faults) {
  for (const char* name : {"do_thermal_expansion", "DoThermalExpansion"}) {
    const std::unique_ptr<DeckNode> flag = take(flags, name);
    if (flag == nullptr) continue;
    bool grows = false;
    for_materials(root, [&](DeckNode& material) {
      const auto coefficient = real_of(&material, "linear_thermal_expansion_coef");
      grows = grows || (coefficient && *coefficient != 0);
    });
    if (flag->text == "false" && grows)
      add_not_built(faults, flag->where,
                    fmt::format("<{}> false with a <linear_thermal_expansion_coef>", name),
                    "write 0 for the coefficient");
    else
      add_warning(faults, flag->where, fmt::format("<{}> is obsolete; dropped", name),
                  "each material has its linear_thermal_expansion_coef");
  }
}

// Damage inside a law is that of the material.
void move_damage(DeckNode& material, std::vector<Fault>& faults) {
  constexpr const char* of_scalar[] = {"initial_mean_scalar_damage", "initial_std_scalar_damage",
                                       "initial_scalar_damage_distrib", "critical_scalar_damage"};
  DeckNode* law = material.child("constitutive_model");
  if (law == nullptr) return;
  std::unique_ptr<DeckNode> damage = take(*law, "damage_model");
  DeckNode* present = material.child("damage_model");
  if (damage != nullptr)
    add_warning(
        faults, damage->where,
        "<damage_model> in <constitutive_model> is obsolete; read as that of its <material>");
  if (damage != nullptr && present != nullptr) {
    add_error(faults, damage->where,
              fmt::format("a second <damage_model>; the first is at {}", to_string(present->where)),
              "remove one of them");
    return;
  }
  DeckNode* to = damage != nullptr ? damage.get() : present;
  for (const char* name : of_scalar) {
    std::unique_ptr<DeckNode> part = take(*law, name);
    if (part == nullptr) continue;
    const bool read = to != nullptr && to->child(name) == nullptr;
    add_warning(faults, part->where,
                fmt::format("<{}> in <constitutive_model> is obsolete; {}", name,
                            read ? "read as inside <damage_model>" : "dropped"),
                read ? "" : "<damage_model> determines it");
    if (read) to->children.push_back(std::move(part));
  }
  if (damage != nullptr) material.children.push_back(std::move(damage));
}

// Damage of materials in the form before <damage_model>.
void refuse_basic_damage(DeckNode& material, std::vector<Fault>& faults) {
  const std::unique_ptr<DeckNode> flag = take(material, "do_basic_damage");
  if (flag == nullptr) return;
  if (flag->text == "false")
    add_warning(faults, flag->where, "<do_basic_damage> is obsolete; dropped",
                "<damage_model> determines it");
  else
    add_not_built(faults, flag->where, fmt::format("<do_basic_damage> {}", flag->text),
                  "write <damage_model type=\"Brittle\"> or \"Threshold\" with its constants");
}

// The density of a material is told once.
void drop_density_of_law(DeckNode& material, std::vector<Fault>& faults) {
  DeckNode* law = material.child("constitutive_model");
  DeckNode* state = law == nullptr ? nullptr : law->child("equation_of_state");
  if (state == nullptr) return;
  const auto density = real_of(&material, "density"), own = real_of(state, "rho_0");
  const std::unique_ptr<DeckNode> given = take(*state, "rho_0");
  if (given == nullptr) return;
  const bool differ = density && own && *density != *own;
  add_warning(faults, given->where,
              differ ? fmt::format("<rho_0> {:g} in <equation_of_state> is obsolete; dropped: the "
                                   "material's <density> {:g} is used",
                                   *own, *density)
                     : "<rho_0> in <equation_of_state> is obsolete; dropped",
              "a solid's density is that of its material");
}

}  // namespace

void read_old_words(DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  if (DeckNode* flags = root.child("MPM")) {
    give_erosion(root, *flags, faults);
    read_node_count(*flags, faults);
    read_expansion(root, *flags, faults);
  }
  for_materials(root, [&](DeckNode& material) {
    move_damage(material, faults);
    refuse_basic_damage(material, faults);
    drop_density_of_law(material, faults);
  });
}

}  // namespace sluice::mpm
