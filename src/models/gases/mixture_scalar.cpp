// The scalar of a mixed gas: tags, checks, reading.
#include "models/gases/mixture_scalar.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "models/deck/material_name.hpp"
#include "models/scalars/passive_scalar.hpp"

namespace sluice::models {

std::vector<TagSpec> mixture_tags(const char* scalar_doc, const std::vector<TagSpec>& further) {
  return {tag("material", "name of the material").once().text(),
          tag("scalar", scalar_doc)
              .once()
              .attribute(attribute("name", "name of the scalar; variables are called scalar-NAME")
                             .once()
                             .text())
              .child(tag("test_conservation", "the total of the scalar is written")
                         .boolean()
                         .by_default("false"))
              .with_children(further)
              .child(scalar_region_tag())};
}

std::vector<TagSpec> diffusion_tags() {
  return {tag("diffusivity", "coefficient D of the flux rho D grad f")
              .real()
              .at_least(0)
              .by_default("0")
              .unit("length^2/time"),
          tag("AMR_Refinement_Criteria", "cells with a larger gradient of f are flagged")
              .real()
              .at_least(0)
              .unit("1/length")};
}

const DeckNode* check_mixture(const DeckNode& parameters, const std::vector<std::string>& materials,
                              std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  const DeckNode* scalar = parameters.child("scalar");
  if (scalar == nullptr) return nullptr;
  for (const DeckNode* object : scalar->all("geom_object")) check_scalar_region(*object, faults);
  return scalar;
}

void check_alone(const DeckNode& parameters, const std::vector<std::string>& materials,
                 std::vector<Fault>& faults) {
  if (materials.size() > 1)
    add_not_built(faults, parameters.where,
                  fmt::format("<{}> with several materials", parameters.name),
                  "remove the other materials, or use <BinaryProperties>");
}

MixedGas read_mixture(const DeckNode& parameters, const std::vector<std::string>& materials) {
  MixedGas gas;
  gas.type = parameters.name;
  gas.fractions = {parameters.child("scalar")->attribute("name").value_or("")};
  gas.material = read_material(parameters, "material", materials);
  gas.where = parameters.where;
  return gas;
}

std::vector<TransportedScalar> read_mixture_scalars(const MixedGas& gas, const DeckNode& scalar,
                                                    const char* constants,
                                                    const GeometryReader& geometry,
                                                    std::vector<Fault>& faults) {
  TransportedScalar f;
  f.material = gas.material;
  f.by_volume = true;
  read_scalar_constants(scalar, f, constants);
  f.start = read_scalar_regions(scalar, geometry, faults);
  if (gas.released.empty()) return {f};
  TransportedScalar q;
  q.name = gas.released;
  q.plain_name = q.by_volume = true;
  q.material = gas.material;
  q.diffusivity = f.diffusivity;
  q.where = gas.where;
  return {f, q};
}

std::vector<std::string> mixing_labels(const DeckNode& parameters) {
  std::vector<std::string> labels = scalar_labels(parameters);
  TransportedScalar q;
  q.name = cumulative_energy;
  q.plain_name = true;
  for (const std::string& label : labels_of(q)) labels.push_back(label);
  return labels;
}

}  // namespace sluice::models
