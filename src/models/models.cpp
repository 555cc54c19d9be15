// The table of models.
#include "models/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/base/infinity.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/burn/jwlpp.hpp"
#include "models/burn/light_time.hpp"
#include "models/deck/material_name.hpp"
#include "models/gases/adiabatic_table.hpp"
#include "models/gases/binary_properties.hpp"
#include "models/gases/flame_sheet.hpp"
#include "models/gases/gas_combustion.hpp"
#include "models/gases/mixture_scalar.hpp"

namespace sluice::models {
namespace {

struct Reading {
  const std::vector<std::string>& materials;  // fluids
  const MaterialNames& names;
  const GeometryReader& geometry;
  ModelList& list;
  std::vector<Fault>& faults;
};

// One type of model: the word in <Model type=>, and the element that holds its parameters.
struct Entry {
  const char* type;
  TagSpec parameters;
  void (*check)(const DeckNode& parameters, const MaterialNames& names, std::vector<Fault>& faults);
  void (*read)(const DeckNode& parameters, const Reading& to);
  // Names of variables that it brings; null: none.
  std::vector<std::string> (*labels)(const DeckNode& parameters) = nullptr;
  bool mixes = false;  // the gas
  std::optional<double> (*coefficient)(const DeckNode& parameters, Coefficient) = nullptr;
  // Where the reactant is a solid.
  SolidBurn (*burn)(const DeckNode& parameters, const MaterialNames& names) = nullptr;
};

// A mixed gas and its scalars; `constants`: the element with <diffusivity>.
void add_gas(const DeckNode& parameters, const char* constants, MixedGas gas, const Reading& to) {
  for (TransportedScalar& s :
       read_mixture_scalars(gas, *parameters.child("scalar"), constants, to.geometry, to.faults))
    to.list.scalars.push_back(std::move(s));
  to.list.mixed = std::move(gas);
}

void add_species(const DeckNode& parameters, const Reading& to) {
  MixedGas gas = read_gas_combustion(parameters, to.materials);
  for (TransportedScalar& s : read_species(gas, parameters, to.geometry, to.faults))
    to.list.scalars.push_back(std::move(s));
  to.list.mixed = std::move(gas);
}

std::optional<double> species_coefficient(const DeckNode& parameters, Coefficient) {
  if (is_true(&parameters, "doDiffusion")) return infinity;
  return std::nullopt;
}

// Rules of models that know fluids alone.
template <auto check>
void of_fluids(const DeckNode& parameters, const MaterialNames& names, std::vector<Fault>& faults) {
  check(parameters, names.fluids, faults);
}

// Of a fluid; what solids give is told by `burn`.
void add_exchange(const DeckNode& parameters, const Reading& to,
                  MassExchange (*read)(const DeckNode&, const MaterialNames&)) {
  if (!read_reactant(parameters, to.names).solid)
    to.list.mass_exchanges.push_back(read(parameters, to.names));
}

template <auto read>
SolidBurn burn(const DeckNode& parameters, const MaterialNames& names) {
  const Reactant reactant = read_reactant(parameters, names);
  return {reactant.from, reactant.to, read(parameters, names), parameters.where};
}

const std::vector<Entry>& table() {
  static const std::vector<Entry> entries = {
      {"Test", mass_exchange_tag(), check_reactant,
       [](const DeckNode& parameters, const Reading& to) {
         add_exchange(parameters, to, read_mass_exchange);
       },
       nullptr, false, nullptr, burn<read_mass_exchange>},
      {"JWLpp", jwlpp_tag(), check_reactant,
       [](const DeckNode& parameters, const Reading& to) {
         add_exchange(parameters, to, read_jwlpp);
       },
       nullptr, false, nullptr, burn<read_jwlpp>},
      {"LightTime", light_time_tag(), check_fluid_reactant,
       [](const DeckNode& parameters, const Reading& to) {
         add_exchange(parameters, to, read_light_time);
       },
       [](const DeckNode& /*parameters*/) {
         return std::vector<std::string>{front_gradient_label().name()};
       }},
      {"Simple_Burn", simple_burn_tag(), check_solid_reactant,
       [](const DeckNode& /*parameters*/, const Reading& /*to*/) {}, nullptr, false, nullptr,
       burn<read_simple_burn>},
      {"Steady_Burn", steady_burn_tag(), check_solid_reactant,
       [](const DeckNode& /*parameters*/, const Reading& /*to*/) {}, nullptr, false, nullptr,
       burn<read_steady_burn>},
      {"Unsteady_Burn", unsteady_burn_tag(), check_solid_reactant,
       [](const DeckNode& /*parameters*/, const Reading& /*to*/) {}, nullptr, false, nullptr,
       burn<read_unsteady_burn>},
      {"DDT1", ddt1_tag(), check_ddt1, [](const DeckNode& /*parameters*/, const Reading& /*to*/) {},
       nullptr, false, nullptr, burn<read_ddt1>},
      {"mass_momentum_energy_src", fixed_values_tag(), of_fluids<check_fixed_values>,
       [](const DeckNode& parameters, const Reading& to) {
         for (FixedValues& v : read_fixed_values(parameters, to.materials, to.geometry, to.faults))
           to.list.fixed_values.push_back(std::move(v));
       }},
      {"PassiveScalar", passive_scalar_tag(), of_fluids<check_passive_scalar>,
       [](const DeckNode& parameters, const Reading& to) {
         to.list.scalars.push_back(
             read_passive_scalar(parameters, to.materials, to.geometry, to.faults));
       },
       scalar_labels},
      {"BinaryProperties", binary_properties_tag(), of_fluids<check_binary_properties>,
       [](const DeckNode& parameters, const Reading& to) {
         add_gas(parameters, "constants", read_binary_properties(parameters, to.materials), to);
       },
       scalar_labels, true, largest_binary_coefficient},
      {"AdiabaticTable", adiabatic_table_tag(), of_fluids<check_adiabatic_table>,
       [](const DeckNode& parameters, const Reading& to) {
         add_gas(parameters, "constants", read_adiabatic_table(parameters, to.materials, to.faults),
                 to);
       },
       mixing_labels, true,
       [](const DeckNode&, Coefficient) -> std::optional<double> { return infinity; }},
      {"flameSheet_rxn", flame_sheet_tag(), of_fluids<check_flame_sheet>,
       [](const DeckNode& parameters, const Reading& to) {
         add_gas(parameters, "reaction_constants", read_flame_sheet(parameters, to.materials), to);
       },
       mixing_labels, true},
      {"gasCombustion", gas_combustion_tag(), of_fluids<check_gas_combustion>, add_species,
       species_labels, true, species_coefficient},
      {"hydrogenBurke", hydrogen_burke_tag(), of_fluids<check_gas_combustion>, add_species,
       species_labels, true, species_coefficient},
      {"TracerParticles", tracer_particles_tag(), of_fluids<check_tracer_particles>,
       [](const DeckNode& parameters, const Reading& to) {
         to.list.tracers.push_back(
             read_tracer_particles(parameters, to.materials, to.geometry, to.faults));
       },
       tracer_labels},
  };
  return entries;
}

const Entry* find(const std::string& type) {
  for (const Entry& entry : table())
    if (type == entry.type) return &entry;
  return nullptr;
}

// Known to the format.
std::vector<std::string> not_built() {
  std::vector<std::string> types = {"AdiabaticTable",
                                    "BinaryProperties",
                                    "ConstantSources",
                                    "DDT0",
                                    "DDT1",
                                    "IandG",
                                    "JWLpp",
                                    "LightTime",
                                    "MesoBurn",
                                    "PassiveScalar",
                                    "Radiation",
                                    "Simple_Burn",
                                    "Steady_Burn",
                                    "TracerParticles",
                                    "SolidReactionModel",
                                    "Unsteady_Burn",
                                    "ZeroOrder",
                                    "ethyleneDetonation",
                                    "flameSheet_rxn",
                                    "gasCombustion",
                                    "hydrogenBurke"};
  std::erase_if(types, [](const std::string& type) { return find(type) != nullptr; });
  return types;
}

// Calls f(entry, parameters) for every model of the deck that is built and has its element.
template <class F>
void for_each_model(const DeckNode& root, F&& f) {
  const DeckNode* models = root.child("Models");
  if (models == nullptr) return;
  for (const DeckNode* model : models->all("Model")) {
    const Entry* entry = find(model->attribute("type").value_or(""));
    const DeckNode* parameters = entry == nullptr ? nullptr : model->child(entry->parameters.name);
    if (parameters != nullptr) f(*entry, *parameters);
  }
}

}  // namespace

bool mixes_gas(const std::string& type) {
  const Entry* entry = find(type);
  return entry != nullptr && entry->mixes;
}

std::optional<double> own_coefficient(const DeckNode& model, Coefficient coefficient) {
  const Entry* entry = find(model.attribute("type").value_or(""));
  if (entry == nullptr || entry->coefficient == nullptr) return std::nullopt;
  const DeckNode* parameters = model.child(entry->parameters.name);
  if (parameters == nullptr) return std::nullopt;
  return entry->coefficient(*parameters, coefficient);
}

TagSpec models_tag() {
  std::vector<std::string> types;
  TagSpec model = tag("Model", "one of them; several of a type may stand side by side").multiple();
  std::vector<TagSpec> elements;
  for (const Entry& entry : table()) {
    types.emplace_back(entry.type);
    elements.push_back(entry.parameters.once().only_for("type", {entry.type}));
  }
  return tag("Models", "sources and exchange beside the flow itself")
      .child(model
                 .attribute(attribute("type",
                                      "which one; its parameters stand in an element of "
                                      "its own")
                                .once()
                                .words(types)
                                .not_built(not_built()))
                 .with_children(elements));
}

namespace {

// Parameters beside the element of their model, as older decks have them.
void put_into_element(DeckNode& model, const std::string& element_name,
                      std::vector<Fault>& faults) {
  auto element = std::make_unique<DeckNode>();
  element->name = element_name;
  element->where = model.where;
  element->children.swap(model.children);
  model.children.push_back(std::move(element));
  add_warning(
      faults, model.where,
      fmt::format("<Model>: parameters beside <{0}> are obsolete; read as inside it", element_name),
      fmt::format("write <{}> around them", element_name));
}

// Regions of a passive scalar, likewise.
void put_regions_into_start(DeckNode& scalar, std::vector<Fault>& faults) {
  std::vector<std::unique_ptr<DeckNode>> regions;
  for (auto& child : scalar.children)
    if (child->name == "geom_object") regions.push_back(std::move(child));
  std::erase(scalar.children, nullptr);
  if (regions.empty()) return;
  add_warning(faults, regions.front()->where,
              "<geom_object> in <scalar> is obsolete; read as inside <initialization>");
  DeckNode* start = scalar.child("initialization");
  if (start == nullptr) {
    auto made = std::make_unique<DeckNode>();
    made->name = "initialization";
    made->where = regions.front()->where;
    start = scalar.children.emplace_back(std::move(made)).get();
  }
  for (auto& region : regions) start->children.push_back(std::move(region));
}

}  // namespace

void move_parameters(DeckNode& root, std::vector<Fault>& faults) {
  for (const auto& models : root.children) {
    if (models->name != "Models") continue;
    for (const auto& model : models->children) {
      const Entry* entry = find(model->attribute("type").value_or(""));
      if (entry == nullptr) continue;
      const std::string& element = entry->parameters.name;
      const bool of_another = std::any_of(table().begin(), table().end(), [&](const Entry& other) {
        return model->child(other.parameters.name) != nullptr;
      });
      if (!of_another && !model->children.empty()) put_into_element(*model, element, faults);
      if (element != "PassiveScalar") continue;
      if (DeckNode* parameters = model->child(element))
        if (DeckNode* scalar = parameters->child("scalar")) put_regions_into_start(*scalar, faults);
    }
  }
}

void check_models(const DeckNode& root, const MaterialNames& materials,
                  std::vector<Fault>& faults) {
  std::set<std::string> labels;
  std::set<int> traced;
  std::set<std::pair<std::string, int>> remembering;
  const auto& of_all_particles = particle_variables();
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    entry.check(parameters, materials, faults);
    if ((parameters.name == "Unsteady_Burn" || parameters.name == "DDT1") &&
        !remembering
             .insert({parameters.name, read_material(parameters, "fromMaterial", materials.all())})
             .second)
      return add_error(faults, parameters.where,
                       fmt::format("two <{}> of the same material", parameters.name),
                       "particles can follow one of them alone");
    if (entry.labels == nullptr) return;
    if (entry.labels == tracer_labels &&
        !traced.insert(read_material(parameters, "material", materials.fluids)).second)
      return add_error(faults, parameters.where, "two <TracerParticles> of the same material",
                       "write the regions of both into one");
    for (const std::string& label : entry.labels(parameters))
      if (std::find(of_all_particles.begin(), of_all_particles.end(), label) ==
              of_all_particles.end() &&
          !labels.insert(label).second)
        return add_error(faults, parameters.where,
                         fmt::format("two models bring a variable {}", label),
                         "give each scalar a name of its own");
  });
  const std::vector<std::string> scalars = scalar_variables(root);
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    const DeckNode* clones = parameters.child("cloneVariables");
    if (entry.labels != tracer_labels || clones == nullptr) return;
    for (const DeckNode* clone : clones->all("CCVarLabel")) {
      const std::string label = clone->attribute("label").value_or("");
      if (!label.starts_with("scalar-") ||
          std::find(scalars.begin(), scalars.end(), label) == scalars.end())
        add_error(faults, clone->where,
                  fmt::format("<CCVarLabel label=\"{}\">: particles have copies of scalars of the "
                              "deck's models alone",
                              label),
                  suggest_name(label, scalars));
    }
  });
}

ModelList read_models(const DeckNode& root, const MaterialNames& materials,
                      const GeometryReader& geometry, std::vector<Fault>& faults) {
  ModelList list;
  if (const DeckNode* models = root.child("Models")) list.where = models->where;
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    entry.read(parameters, {materials.fluids, materials, geometry, list, faults});
  });
  return list;
}

std::vector<SolidBurn> read_burns(const DeckNode& root, const MaterialNames& materials) {
  std::vector<SolidBurn> burns;
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    if (entry.burn != nullptr && read_reactant(parameters, materials).solid)
      burns.push_back(entry.burn(parameters, materials));
  });
  return burns;
}

bool all_built(const DeckNode& root) {
  const DeckNode* models = root.child("Models");
  if (models == nullptr) return true;
  const auto entries = models->all("Model");
  return std::all_of(entries.begin(), entries.end(), [](const DeckNode* model) {
    return find(model->attribute("type").value_or("")) != nullptr;
  });
}

std::vector<std::string> save_labels(const DeckNode& root) {
  std::vector<std::string> labels;
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    if (entry.labels == nullptr) return;
    for (std::string& label : entry.labels(parameters)) labels.push_back(std::move(label));
  });
  return labels;
}

std::vector<std::string> scalar_variables(const DeckNode& root) {
  std::vector<std::string> labels = save_labels(root);
  const std::set<std::string> all(labels.begin(), labels.end());
  std::erase_if(labels,
                [&](const std::string& label) { return !all.contains("totalSum_" + label); });
  return labels;
}

}  // namespace sluice::models
