// Model "BinaryProperties": how a deck says it.
#include "models/gases/binary_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/gases/mixture_scalar.hpp"

namespace sluice::models {
namespace {

// Of gas A and of gas B.
using TagPair = std::array<const char*, 2>;
constexpr TagPair heat_capacities = {"cv_A", "cv_B"}, gas_constants = {"R_A", "R_B"},
                  densities = {"rho_A", "rho_B"},
                  conductivities = {"thermalCond_A", "thermalCond_B"},
                  viscosities = {"dynamic_viscosity_A", "dynamic_viscosity_B"};

// Both, or nothing where the deck has neither.
std::optional<std::array<double, 2>> both_of(const DeckNode& constants, const TagPair& tags) {
  if (constants.child(tags[0]) == nullptr) return std::nullopt;
  return std::array{constants.real(tags[0]), constants.real(tags[1])};
}

TagSpec constants() {
  const auto needed = [](const char* name, const char* doc) {
    return tag(name, doc).once().real().above(0).unit("energy/(mass temperature)");
  };
  TagSpec c = tag("constants", "constants of the scalar and of both gases")
                  .once()
                  .with_children(diffusion_tags())
                  .with_children({needed("cv_A", "specific heat at constant volume where f is 0"),
                                  needed("cv_B", "specific heat at constant volume where f is 1"),
                                  needed("R_A", "gas constant where f is 0"),
                                  needed("R_B", "gas constant where f is 1")});
  const auto pair = [&](const TagPair& tags, const char* doc, const char* unit) {
    for (std::size_t k = 0; k < 2; ++k)
      c = c.child(tag(tags[k], fmt::format(fmt::runtime(doc), k)).real().at_least(0).unit(unit));
  };
  pair(densities, "initial density for f = {}; absent: that of the geometry objects", "density");
  pair(conductivities, "thermal conductivity for f = {}; absent: that of the material",
       "power/(length temperature)");
  pair(viscosities, "dynamic viscosity for f = {}; absent: that of the material", "pressure time");
  return c;
}

}  // namespace

TagSpec binary_properties_tag() {
  return tag("BinaryProperties", "an ideal gas that is a mixture of two gases, by mass fraction")
      .with_children(mixture_tags("the mass fraction of gas B", {constants()}));
}

void check_binary_properties(const DeckNode& parameters, const std::vector<std::string>& materials,
                             std::vector<Fault>& faults) {
  const DeckNode* scalar = check_mixture(parameters, materials, faults);
  const DeckNode* constants = scalar == nullptr ? nullptr : scalar->child("constants");
  if (constants == nullptr) return;
  for (const TagPair& tags : {densities, conductivities, viscosities})
    for (std::size_t k = 0; k < 2; ++k)
      if (constants->child(tags[k]) != nullptr && constants->child(tags[1 - k]) == nullptr)
        add_error(
            faults, constants->child(tags[k])->where,
            fmt::format("<{}> needs <{}>: one for each of the two gases", tags[k], tags[1 - k]));
  for (const char* name : densities)
    if (real_of(constants, name).value_or(1) == 0)
      add_error(faults, constants->child(name)->where, fmt::format("<{}> must be above 0", name));
}

std::optional<double> largest_binary_coefficient(const DeckNode& parameters,
                                                 Coefficient coefficient) {
  const DeckNode* scalar = parameters.child("scalar");
  const DeckNode* constants = scalar == nullptr ? nullptr : scalar->child("constants");
  if (constants == nullptr) return std::nullopt;
  const TagPair& tags = coefficient == Coefficient::viscosity ? viscosities : conductivities;
  const auto a = real_of(constants, tags[0]), b = real_of(constants, tags[1]);
  if (!a && !b) return std::nullopt;
  return std::max(a.value_or(0), b.value_or(0));
}

MixedGas read_binary_properties(const DeckNode& parameters,
                                const std::vector<std::string>& materials) {
  const DeckNode& constants = *parameters.child("scalar")->child("constants");
  MixedGas gas = read_mixture(parameters, materials);
  gas.own_heat_capacity = true;
  gas.start_density = both_of(constants, densities);
  const auto mu = both_of(constants, viscosities), k = both_of(constants, conductivities);
  gas.own_viscosity = mu.has_value();
  gas.own_conductivity = k.has_value();
  std::vector<MixedGas::Node> nodes(2);
  for (std::size_t n = 0; n < 2; ++n) {
    nodes[n].f = static_cast<double>(n);
    nodes[n].cv = constants.real(heat_capacities[n]);
    nodes[n].R = constants.real(gas_constants[n]);
    if (mu) nodes[n].viscosity = (*mu)[n];
    if (k) nodes[n].conductivity = (*k)[n];
  }
  gas.set_nodes(std::move(nodes));
  return gas;
}

}  // namespace sluice::models
