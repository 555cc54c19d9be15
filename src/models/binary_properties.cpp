// Model "BinaryProperties": how a deck says it.
#include "models/binary_properties.hpp"

#include <fmt/format.h>

#include "framework/deck/rule_tools.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/material_name.hpp"
#include "models/passive_scalar.hpp"

namespace sluice::models {
namespace {

constexpr const char* of_transport[] = {"thermalCond_A", "thermalCond_B", "dynamic_viscosity_A",
                                        "dynamic_viscosity_B"};

TagSpec constants() {
  const auto needed = [](const char* name, const char* doc) {
    return tag(name, doc).once().real().above(0).unit("energy/(mass temperature)");
  };
  TagSpec c =
      tag("constants", "of the scalar and of both gases")
          .once()
          .with_children(
              {tag("diffusivity", "coefficient D of the flux rho D grad f")
                   .real()
                   .at_least(0)
                   .by_default("0")
                   .unit("length^2/time"),
               tag("AMR_Refinement_Criteria", "cells with a larger gradient of f are flagged")
                   .real()
                   .at_least(0)
                   .unit("1/length"),
               needed("cv_A", "specific heat at constant volume where f is 0"),
               needed("cv_B", "specific heat at constant volume where f is 1"),
               needed("R_A", "gas constant where f is 0"),
               needed("R_B", "gas constant where f is 1"),
               tag("rho_A", "accepted without effect: geometry objects say the density at start")
                   .real()
                   .above(0)
                   .unit("density"),
               tag("rho_B", "accepted without effect, as rho_A").real().above(0).unit("density")});
  for (const char* name : of_transport) c = c.child(tag(name, "must be 0").real().at_least(0));
  return c;
}

}  // namespace

TagSpec binary_properties_tag() {
  return tag("BinaryProperties", "an ideal gas that is a mixture of two, by mass fraction")
      .with_children(
          {tag("material", "name of the material").once().text(),
           tag("scalar", "the mass fraction of gas B")
               .once()
               .attribute(
                   attribute("name", "its name; variables are called scalar-NAME").once().text())
               .with_children(
                   {tag("test_conservation", "its total is written").boolean().by_default("false"),
                    constants(), scalar_region_tag()})});
}

void check_binary_properties(const DeckNode& parameters, const std::vector<std::string>& materials,
                             std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  const auto not_built = [&](const DeckNode& node, const std::string& what, const char* advice) {
    add_error(faults, node.where, what + " is known to the format, but not built yet", advice);
    faults.back().not_built = true;
  };
  if (materials.size() > 1) not_built(parameters, "<BinaryProperties> with several materials", "");
  const DeckNode* scalar = parameters.child("scalar");
  if (scalar == nullptr) return;
  for (const DeckNode* object : scalar->all("geom_object")) check_scalar_region(*object, faults);
  const DeckNode* constants = scalar->child("constants");
  for (const char* name : of_transport)
    if (real_of(constants, name).value_or(0) > 0)
      not_built(*constants->child(name), fmt::format("<{}> above 0", name), "write 0");
}

BinaryGas read_binary_properties(const DeckNode& parameters,
                                 const std::vector<std::string>& materials) {
  const DeckNode& scalar = *parameters.child("scalar");
  const DeckNode& constants = *scalar.child("constants");
  BinaryGas gas;
  gas.scalar = scalar.attribute("name").value_or("");
  gas.material = read_material(parameters, "material", materials);
  gas.cv_A = constants.real("cv_A");
  gas.cv_B = constants.real("cv_B");
  gas.R_A = constants.real("R_A");
  gas.R_B = constants.real("R_B");
  gas.where = parameters.where;
  return gas;
}

TransportedScalar read_binary_scalar(const DeckNode& parameters,
                                     const std::vector<std::string>& materials,
                                     const GeometryReader& geometry, std::vector<Fault>& faults) {
  const DeckNode& scalar = *parameters.child("scalar");
  TransportedScalar s;
  s.material = read_material(parameters, "material", materials);
  s.by_volume = true;
  read_scalar_constants(scalar, s);
  s.start = read_scalar_regions(scalar, geometry, faults);
  return s;
}

}  // namespace sluice::models
