// Model "flameSheet_rxn": how a deck says it.
#include "models/gases/flame_sheet.hpp"

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/gases/mixture_scalar.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::models {

std::vector<MixedGas::Node> flame_sheet_nodes(double f_st, double heat) {
  std::vector<MixedGas::Node> nodes(3);
  nodes[1].f = f_st;
  nodes[1].heat = heat * f_st;
  nodes[2].f = 1;
  return nodes;
}

TagSpec flame_sheet_tag() {
  const auto temperature = [](const char* name, const char* doc) {
    return tag(name, doc).once().real().above(0).unit("temperature");
  };
  const TagSpec constants =
      tag("reaction_constants", "constants of the flame")
          .once()
          .with_children(
              {tag("f_stoichometric", "mass fraction of fuel at which both streams are used up")
                   .once()
                   .real()
                   .above(0)
                   .at_most(1),
               tag("delta_H_combustion", "heat of reaction per mass of fuel")
                   .once()
                   .real()
                   .at_least(0)
                   .unit("energy/mass"),
               temperature("oxidizer_temp_infinity",
                           "temperature of the oxidizer, in the law T(f)"),
               temperature("initial_fuel_temp", "temperature of the fuel, in the law T(f)"),
               tag("diffusivity", "coefficient D of the flux rho D grad f")
                   .once()
                   .real()
                   .at_least(0)
                   .unit("length^2/time")});
  return tag("flameSheet_rxn", "fuel and oxidizer that burn immediately where they mix")
      .with_children(mixture_tags("the mass fraction of the fuel stream", {constants}));
}

void check_flame_sheet(const DeckNode& parameters, const std::vector<std::string>& materials,
                       std::vector<Fault>& faults) {
  const DeckNode* scalar = check_mixture(parameters, materials, faults);
  check_alone(parameters, materials, faults);
  const DeckNode* constants = scalar == nullptr ? nullptr : scalar->child("reaction_constants");
  if (real_of(constants, "f_stoichometric").value_or(0) == 1)
    add_error(faults, constants->child("f_stoichometric")->where,
              "<f_stoichometric> is 1: there would be no excess fuel anywhere",
              "the mass fraction of fuel in a mixture without excess, below 1");
}

MixedGas read_flame_sheet(const DeckNode& parameters, const std::vector<std::string>& materials) {
  const DeckNode& constants = *parameters.child("scalar")->child("reaction_constants");
  MixedGas gas = read_mixture(parameters, materials);
  gas.released = cumulative_energy;
  gas.oxidizer_temperature = constants.real("oxidizer_temp_infinity");
  gas.fuel_temperature = constants.real("initial_fuel_temp");
  gas.set_nodes(
      flame_sheet_nodes(constants.real("f_stoichometric"), constants.real("delta_H_combustion")));
  return gas;
}

}  // namespace sluice::models
