#include "ice/deck/third_order.hpp"

#include <fmt/format.h>

#include "framework/deck/rule_tools.hpp"
#include "ice/deck/schema.hpp"
#include "ice/deck/scheme.hpp"
#include "models/models.hpp"

namespace sluice::ice {
namespace {

const DeckNode* advection_of(const DeckNode& root) {
  const DeckNode* ice = root.find("CFD/ICE");
  return ice == nullptr ? nullptr : ice->child("advection");
}

std::string type_of(const DeckNode& root) {
  const DeckNode* advection = advection_of(root);
  return advection == nullptr ? "" : advection->attribute("type").value_or("");
}

}  // namespace

bool is_third_order(const DeckNode& root) {
  const std::string type = type_of(root);
  return type == "ThirdOrder" || type == "PPM";
}

void check_third_order(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root) || !is_third_order(root)) return;
  const auto refuse = [&](const DeckNode& node, const std::string& what) {
    add_not_built(
        faults, node.where, fmt::format("<advection type=\"{}\"> with {}", type_of(root), what),
        "<advection type=\"SecondOrder\">; ThirdOrder is for one material, explicit steps and the "
        "conservative scheme");
  };
  if (const DeckNode* scheme = root.find("CFD/ICE/scheme"); scheme_of(root).internal_energy)
    refuse(*scheme, "<scheme>classic</scheme>");
  if (const DeckNode* solver = root.find("CFD/ICE/ImplicitSolver"))
    refuse(*solver, "<ImplicitSolver>");
  if (solid_material_count(root) > 0) refuse(*advection_of(root), "solids");
  if (const auto materials = ice_materials(root); materials.size() > 1)
    refuse(*materials[1], "several materials");
  const DeckNode* models = root.child("Models");
  if (models == nullptr) return;
  for (const DeckNode* model : models->all("Model")) {
    const std::string type = model->attribute("type").value_or("");
    if (models::mixes_gas(type)) refuse(*model, fmt::format("a mixture of gases ({})", type));
  }
}

}  // namespace sluice::ice
