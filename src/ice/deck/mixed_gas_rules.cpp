// Rules of decks whose gas is a mixture.
#include "ice/deck/mixed_gas_rules.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/exchange_settings.hpp"
#include "ice/deck/schema.hpp"
#include "models/deck/material_name.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

// The place of the gas that a model makes a mixture.
std::size_t gas_of(const DeckNode& model, const std::vector<std::string>& names) {
  const DeckNode* parameters = model.child(model.attribute("type").value_or(""));
  const DeckNode* material = parameters == nullptr ? nullptr : parameters->child("material");
  const auto m = material == nullptr ? std::nullopt : models::find_material(material->text, names);
  return m.value_or(0);
}

// What it goes without beside other materials.
void check_gas_beside_others(const DeckNode& root, const DeckNode& model,
                             std::vector<Fault>& faults) {
  const std::string name = model.attribute("type").value_or("");
  const auto refuse = [&](const DeckNode* node, const std::string& what, const char* advice) {
    if (node != nullptr)
      add_not_built(faults, node->where,
                    fmt::format("{} with <{}> and other materials", what, name), advice);
  };
  const auto refuse_above_zero = [&](const DeckNode* parent, const char* tag) {
    if (real_of(parent, tag).value_or(0) > 0)
      refuse(parent->child(tag), fmt::format("<{}> above 0", tag), "write 0");
  };
  const DeckNode* constants = &model;
  for (const std::string& step : {name, std::string("scalar"), std::string("constants")})
    constants = constants == nullptr ? nullptr : constants->child(step);
  refuse_above_zero(constants, "diffusivity");
  refuse(root.find("CFD/ICE/turbulence"), "<turbulence>", "remove it");
  refuse(root.find("CFD/ICE/wallShearStress"), "<wallShearStress>", "remove it");
  const ice::ExchangeSettings exchange =
      ice::read_exchange(root, static_cast<int>(ice_materials(root).size()));
  const DeckNode* written = root.find("MaterialProperties/exchange_properties");
  const DeckNode* properties = written != nullptr ? written : &model;
  if (exchange.momentum.min_of_pairs() < ice::one_velocity_coefficient)
    refuse(properties, "one velocity per material",
           "use momentum coefficients of 1e10 or more for all pairs");
  if (exchange.slip) refuse(properties, "slip of a gas along a material", "remove the <Model>");
}

}  // namespace

void check_mixed_gas(const DeckNode& root, const DeckNode& model,
                     const std::vector<std::string>& names, std::vector<Fault>& faults) {
  const auto materials = ice_materials(root);
  if (materials.empty()) return;
  const DeckNode& material = *materials[gas_of(model, names)];
  const std::string name = model.attribute("type").value_or("");
  for (const DeckNode* other : root.child("Models")->all("Model"))
    if (other != &model && models::mixes_gas(other->attribute("type").value_or("")) &&
        other->where.line > model.where.line)
      add_error(faults, other->where,
                fmt::format("a gas can be only one mixture: there are the models <{}> and <{}>",
                            name, other->attribute("type").value_or("")));
  const DeckNode* law = material.child("EOS");
  if (law != nullptr && law->attribute("type") != "ideal_gas")
    add_error(faults, law->where, fmt::format("<{}> needs <EOS type=\"ideal_gas\">", name));
  const auto refuse = [&](const DeckNode* node, const std::string& what, const char* advice) {
    if (node != nullptr)
      add_not_built(faults, node->where, fmt::format("{} with <{}>", what, name), advice);
  };
  refuse(material.child("SpecificHeatModel"), "<SpecificHeatModel>", "remove it");
  const DeckNode* viscosities = material.child("dynamicViscosityModels");
  if (viscosities != nullptr && models::own_coefficient(model, models::Coefficient::viscosity))
    for (const DeckNode* viscosity : viscosities->all("Model"))
      if (viscosity->attribute("name") == "Sutherland")
        add_error(faults, viscosity->where,
                  fmt::format("two viscosity models: <{}> and Sutherland's law", name),
                  "remove one of the two");
  // Whose temperature and energy would be those of another fraction than the cell has.
  for (const DeckNode* other : root.child("Models")->all("Model"))
    for (const char* source : {"mass_momentum_energy_src", "Test"})
      if (other->attribute("type") == source)
        refuse(other, fmt::format("<Model type=\"{}\">", source), "remove one of the two");
  const DeckNode* parameters = model.child(name);
  if (is_true(parameters, "doDiffusion")) {
    const std::string spreading = fmt::format("<doDiffusion> true of <{}> with ", name);
    const auto refuse_spreading = [&](const DeckNode* node, const char* what) {
      if (node != nullptr)
        add_not_built(faults, node->where, spreading + what, "write <doDiffusion> false");
    };
    refuse_spreading(root.find("CFD/ICE/turbulence"), "<turbulence>");
    refuse_spreading(viscosities, "<dynamicViscosityModels>");
  }
  if (materials.size() > 1) check_gas_beside_others(root, model, faults);
  const auto gravity = vector_of(root.child("PhysicalConstants"), "gravity");
  const DeckNode* ice = root.find("CFD/ICE");
  if (materials.size() > 1 && ice != nullptr)
    refuse(ice->child("customInitialization"), "<customInitialization> of several materials",
           "give the initial state with <geom_object>");
  const DeckNode* start = root.find("CFD/ICE/customInitialization");
  const DeckNode* balanced = ice == nullptr ? nullptr : ice->child("applyHydrostaticPressure");
  const bool hydrostatic =
      gravity && !(*gravity == Vec3{}) && (balanced == nullptr || balanced->text != "false");
  if (start != nullptr && !hydrostatic && start->child("formula") == nullptr)
    refuse(start, "<customInitialization> by name",
           "write a <formula> with pressure, or gravity with a hydrostatic start");
}

std::optional<std::size_t> mixed_material(const DeckNode& root,
                                          const std::vector<std::string>& names) {
  if (const DeckNode* models = root.child("Models"))
    for (const DeckNode* model : models->all("Model"))
      if (models::mixes_gas(model->attribute("type").value_or(""))) return gas_of(*model, names);
  return {};
}

}  // namespace sluice
