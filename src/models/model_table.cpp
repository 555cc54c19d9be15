#include "models/model_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/infinity.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
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

// A mixed gas and its scalars; `constants`: the element with <diffusivity>.
void add_gas(const DeckNode& parameters, const char* constants, MixedGas gas,
             const ModelReading& to) {
  for (TransportedScalar& s :
       read_mixture_scalars(gas, *parameters.child("scalar"), constants, to.geometry, to.faults))
    to.list.scalars.push_back(std::move(s));
  to.list.mixed = std::move(gas);
}

void add_species(const DeckNode& parameters, const ModelReading& to) {
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
void add_exchange(const DeckNode& parameters, const ModelReading& to,
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

}  // namespace

// Table: a row for each model.
const std::vector<ModelRow>& model_rows() {
  static const std::vector<ModelRow> entries = {
      {.type = "Test",
       .parameters = mass_exchange_tag(),
       .check = check_reactant,
       .read = [](const DeckNode& parameters,
                  const ModelReading& to) { add_exchange(parameters, to, read_mass_exchange); },
       .burn = read_solid_exchange},
      {.type = "JWLpp",
       .parameters = jwlpp_tag(),
       .check = check_reactant,
       .read = [](const DeckNode& parameters,
                  const ModelReading& to) { add_exchange(parameters, to, read_jwlpp); },
       .burn = read_solid_jwlpp},
      {.type = "LightTime",
       .parameters = light_time_tag(),
       .check = check_fluid_reactant,
       .read = [](const DeckNode& parameters,
                  const ModelReading& to) { add_exchange(parameters, to, read_light_time); },
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
           [](const DeckNode& parameters, const ModelReading& to) {
             for (FixedValues& v :
                  read_fixed_values(parameters, to.materials, to.geometry, to.faults))
               to.list.fixed_values.push_back(std::move(v));
           }},
      {.type = "PassiveScalar",
       .parameters = passive_scalar_tag(),
       .check = with_fluids<check_passive_scalar>,
       .read =
           [](const DeckNode& parameters, const ModelReading& to) {
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
           [](const DeckNode& parameters, const ModelReading& to) {
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
           [](const DeckNode& parameters, const ModelReading& to) {
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
           [](const DeckNode& parameters, const ModelReading& to) {
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
           [](const DeckNode& parameters, const ModelReading& to) {
             to.list.tracers.push_back(
                 read_tracer_particles(parameters, to.materials, to.geometry, to.faults));
           },
       .labels = tracer_labels,
       .once_for = "material",
       .once_reason = "write the regions of both into one"},
  };
  return entries;
}

const ModelRow* find_model(const std::string& type) {
  for (const ModelRow& entry : model_rows())
    if (type == entry.type) return &entry;
  return nullptr;
}

}  // namespace sluice::models
