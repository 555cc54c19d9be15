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
#include "models/burn/ddt1.hpp"
#include "models/burn/jwlpp.hpp"
#include "models/burn/light_time.hpp"
#include "models/burn/simple_burn.hpp"
#include "models/burn/steady_burn.hpp"
#include "models/burn/unsteady_burn.hpp"
#include "models/deck/material_name.hpp"
#include "models/gases/adiabatic_table.hpp"
#include "models/gases/binary_properties.hpp"
#include "models/gases/combustion.hpp"
#include "models/gases/flame_sheet.hpp"
#include "models/gases/gas_combustion.hpp"
#include "models/gases/mixture_scalar.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::models {
namespace {

struct Reading {
  const std::vector<std::string>& materials;  // fluids
  const MaterialNames& names;
  const GeometryReader& geometry;
  ModelList& list;
  std::vector<Fault>& faults;
};

// One type of model: the word in <Model type=>, the element that holds its parameters, and what it
// is asked; null: it has nothing to say there.
struct Entry {
  const char* type;
  TagSpec parameters;
  void (*check)(const DeckNode& parameters, const MaterialNames& names,
                std::vector<Fault>& faults) = nullptr;
  // What it does in fluids.
  void (*read)(const DeckNode& parameters, const Reading& to) = nullptr;
  // Where the reactant is a solid: its law of burning.
  std::shared_ptr<const BurnLaw> (*burn)(const DeckNode& parameters,
                                         const MaterialNames& names) = nullptr;
  // Names of variables that it brings.
  std::vector<std::string> (*labels)(const DeckNode& parameters) = nullptr;
  bool mixes_gas = false;
  bool transports_scalar = false;  // by the flow
  std::optional<double> (*coefficient)(const DeckNode& parameters, Coefficient) = nullptr;
  // The tag that names the material of which this model may be written once alone, and why.
  const char* once_for = nullptr;
  const char* once_reason = nullptr;
  // Brings older forms of its element up to date, with warnings.
  void (*update)(DeckNode& parameters, std::vector<Fault>& faults) = nullptr;
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
void with_fluids(const DeckNode& parameters, const MaterialNames& names,
                 std::vector<Fault>& faults) {
  check(parameters, names.fluids, faults);
}

// Of a fluid; what solids give is told by `burn`.
void add_exchange(const DeckNode& parameters, const Reading& to,
                  MassExchange (*read)(const DeckNode&, const MaterialNames&)) {
  if (!read_reactant(parameters, to.names).solid)
    to.list.mass_exchanges.push_back(read(parameters, to.names));
}

// Regions of a passive scalar beside its <initialization>, as older decks have them: moved into it.
void put_regions_into_start(DeckNode& parameters, std::vector<Fault>& faults) {
  DeckNode* scalar = parameters.child("scalar");
  if (scalar == nullptr) return;
  std::vector<std::unique_ptr<DeckNode>> regions;
  for (auto& child : scalar->children)
    if (child->name == "geom_object") regions.push_back(std::move(child));
  std::erase(scalar->children, nullptr);
  if (regions.empty()) return;
  add_warning(faults, regions.front()->where,
              "<geom_object> in <scalar> is obsolete; read as inside <initialization>");
  DeckNode* start = scalar->child("initialization");
  if (start == nullptr) {
    auto made = std::make_unique<DeckNode>();
    made->name = "initialization";
    made->where = regions.front()->where;
    start = scalar->children.emplace_back(std::move(made)).get();
  }
  for (auto& region : regions) start->children.push_back(std::move(region));
}

constexpr const char* one_alone_moves = "particles can follow only one of them";

// Table: a row for each model.
const std::vector<Entry>& table() {
  static const std::vector<Entry> entries = {
      {.type = "Test",
       .parameters = mass_exchange_tag(),
       .check = check_reactant,
       .read = [](const DeckNode& parameters,
                  const Reading& to) { add_exchange(parameters, to, read_mass_exchange); },
       .burn = read_solid_exchange},
      {.type = "JWLpp",
       .parameters = jwlpp_tag(),
       .check = check_reactant,
       .read = [](const DeckNode& parameters,
                  const Reading& to) { add_exchange(parameters, to, read_jwlpp); },
       .burn = read_solid_jwlpp},
      {.type = "LightTime",
       .parameters = light_time_tag(),
       .check = check_fluid_reactant,
       .read = [](const DeckNode& parameters,
                  const Reading& to) { add_exchange(parameters, to, read_light_time); },
       .labels =
           [](const DeckNode& /*parameters*/) {
             return std::vector<std::string>{front_gradient_label().name()};
           }},
      {.type = "Simple_Burn",
       .parameters = simple_burn_tag(),
       .check = check_solid_reactant,
       .burn = read_simple_burn},
      {.type = "Steady_Burn",
       .parameters = steady_burn_tag(),
       .check = check_solid_reactant,
       .burn = read_steady_burn},
      {.type = "Unsteady_Burn",
       .parameters = unsteady_burn_tag(),
       .check = check_solid_reactant,
       .burn = read_unsteady_burn,
       .once_for = "fromMaterial",
       .once_reason = one_alone_moves},
      {.type = "DDT1",
       .parameters = ddt1_tag(),
       .check = check_ddt1,
       .burn = read_ddt1,
       .once_for = "fromMaterial",
       .once_reason = one_alone_moves},
      {.type = "mass_momentum_energy_src",
       .parameters = fixed_values_tag(),
       .check = with_fluids<check_fixed_values>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             for (FixedValues& v :
                  read_fixed_values(parameters, to.materials, to.geometry, to.faults))
               to.list.fixed_values.push_back(std::move(v));
           }},
      {.type = "PassiveScalar",
       .parameters = passive_scalar_tag(),
       .check = with_fluids<check_passive_scalar>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             to.list.scalars.push_back(
                 read_passive_scalar(parameters, to.materials, to.geometry, to.faults));
           },
       .labels = scalar_labels,
       .transports_scalar = true,
       .update = put_regions_into_start},
      {.type = "BinaryProperties",
       .parameters = binary_properties_tag(),
       .check = with_fluids<check_binary_properties>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             add_gas(parameters, "constants", read_binary_properties(parameters, to.materials), to);
           },
       .labels = scalar_labels,
       .mixes_gas = true,
       .transports_scalar = true,
       .coefficient = largest_binary_coefficient},
      {.type = "AdiabaticTable",
       .parameters = adiabatic_table_tag(),
       .check = with_fluids<check_adiabatic_table>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             add_gas(parameters, "constants",
                     read_adiabatic_table(parameters, to.materials, to.faults), to);
           },
       .labels = mixing_labels,
       .mixes_gas = true,
       .transports_scalar = true,
       .coefficient = [](const DeckNode&, Coefficient) -> std::optional<double> {
         return infinity;
       }},
      {.type = "flameSheet_rxn",
       .parameters = flame_sheet_tag(),
       .check = with_fluids<check_flame_sheet>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             add_gas(parameters, "reaction_constants", read_flame_sheet(parameters, to.materials),
                     to);
           },
       .labels = mixing_labels,
       .mixes_gas = true,
       .transports_scalar = true},
      {.type = "gasCombustion",
       .parameters = gas_combustion_tag(),
       .check = with_fluids<check_gas_combustion>,
       .read = add_species,
       .labels = species_labels,
       .mixes_gas = true,
       .transports_scalar = true,
       .coefficient = species_coefficient},
      {.type = "hydrogenBurke",
       .parameters = hydrogen_burke_tag(),
       .check = with_fluids<check_gas_combustion>,
       .read = add_species,
       .labels = species_labels,
       .mixes_gas = true,
       .transports_scalar = true,
       .coefficient = species_coefficient},
      {.type = "TracerParticles",
       .parameters = tracer_particles_tag(),
       .check = with_fluids<check_tracer_particles>,
       .read =
           [](const DeckNode& parameters, const Reading& to) {
             to.list.tracers.push_back(
                 read_tracer_particles(parameters, to.materials, to.geometry, to.faults));
           },
       .labels = tracer_labels,
       .once_for = "material",
       .once_reason = "write the regions of both into one"},
  };
  return entries;
}

const Entry* find(const std::string& type) {
  for (const Entry& entry : table())
    if (type == entry.type) return &entry;
  return nullptr;
}

// Known to the format, and not supported.
const std::vector<std::string> not_supported = {"ConstantSources", "DDT0",
                                                "IandG",           "MesoBurn",
                                                "Radiation",       "SolidReactionModel",
                                                "ZeroOrder",       "ethyleneDetonation"};

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
  return entry != nullptr && entry->mixes_gas;
}

bool transports_scalar(const DeckNode& model) {
  const Entry* entry = find(model.attribute("type").value_or(""));
  return entry != nullptr && entry->transports_scalar;
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
  TagSpec model = tag("Model", "one model; there may be several of one type").multiple();
  std::vector<TagSpec> elements;
  for (const Entry& entry : table()) {
    types.emplace_back(entry.type);
    elements.push_back(entry.parameters.once().only_for("type", {entry.type}));
  }
  return tag("Models", "sources and exchange in addition to the flow")
      .child(
          model
              .attribute(
                  attribute("type",
                            "type of the model; its parameters are in an element of the same name")
                      .once()
                      .words(types)
                      .not_built(not_supported))
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
  add_warning(faults, model.where,
              fmt::format("<Model>: parameters outside <{0}> are obsolete; read as inside it",
                          element_name),
              fmt::format("write <{}> around them", element_name));
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
      DeckNode* parameters = model->child(element);
      if (parameters != nullptr && entry->update != nullptr) entry->update(*parameters, faults);
    }
  }
}

void check_models(const DeckNode& root, const MaterialNames& materials,
                  std::vector<Fault>& faults) {
  std::set<std::string> labels;
  std::set<std::pair<std::string, int>> written;
  const auto& of_all_particles = particle_variables();
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    entry.check(parameters, materials, faults);
    // What burns is a solid or a fluid, all else is a fluid.
    const std::vector<std::string> names =
        entry.burn != nullptr ? materials.all() : materials.fluids;
    if (entry.once_for != nullptr &&
        !written.insert({entry.type, read_material(parameters, entry.once_for, names)}).second)
      return add_error(faults, parameters.where,
                       fmt::format("two <{}> of the same material", parameters.name),
                       entry.once_reason);
    if (entry.labels == nullptr) return;
    for (const std::string& label : entry.labels(parameters))
      if (std::find(of_all_particles.begin(), of_all_particles.end(), label) ==
              of_all_particles.end() &&
          !labels.insert(label).second)
        return add_error(faults, parameters.where,
                         fmt::format("two models bring a variable {}", label),
                         "give each scalar a different name");
  });
  const std::vector<std::string> scalars = scalar_variables(root);
  for_each_model(root, [&](const Entry& /*entry*/, const DeckNode& parameters) {
    const DeckNode* clones = parameters.child("cloneVariables");
    if (clones == nullptr) return;
    for (const DeckNode* clone : clones->all("CCVarLabel")) {
      const std::string label = clone->attribute("label").value_or("");
      if (!label.starts_with("scalar-") ||
          std::find(scalars.begin(), scalars.end(), label) == scalars.end())
        add_error(faults, clone->where,
                  fmt::format("<CCVarLabel label=\"{}\">: particles can have copies only of "
                              "scalars of the deck's models",
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
    if (entry.read != nullptr)
      entry.read(parameters, {materials.fluids, materials, geometry, list, faults});
  });
  return list;
}

std::vector<SolidBurn> read_burns(const DeckNode& root, const MaterialNames& materials) {
  std::vector<SolidBurn> burns;
  for_each_model(root, [&](const Entry& entry, const DeckNode& parameters) {
    if (entry.burn == nullptr) return;
    const Reactant reactant = read_reactant(parameters, materials);
    if (reactant.solid)
      burns.push_back(
          {reactant.from, reactant.to, entry.burn(parameters, materials), parameters.where});
  });
  return burns;
}

void declare_labels() {
  TransportedScalar scalar;
  scalar.name = "NAME";
  scalar.declare_labels();
  front_gradient_label();
  reaction_labels();
  TracerScalar of_tracers;
  of_tracers.name = "p.NAME";
  of_tracers.label();
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
