// Model "mass_momentum_energy_src": how a deck says it.
#include "models/sources/fixed_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/deck/material_name.hpp"

namespace sluice::models {
namespace {

TagSpec algorithm() {
  const std::vector<std::string> fixed{"fixedPrimitiveValues"};
  const auto needed = [&](const char* name, const char* doc) {
    return tag(name, doc).once().only_for("type", fixed);
  };
  return tag("algorithm", "how the sources follow from what the deck gives")
      .once()
      .attribute(attribute("type",
                           "fixedPrimitiveValues: as much as brings the material to these "
                           "values in each step")
                     .once()
                     .words(fixed))
      .with_children(
          {needed("velocity_src", "velocity").vector().unit("velocity"),
           needed("density_src", "density of the material itself").real().above(0).unit("density"),
           needed("temperature_src", "temperature").real().above(0).unit("temperature"),
           tag("timeStart", "from when on").real().at_least(0).unit("time").by_default("0"),
           tag("timeStop", "until when; absent: to the end").real().above(0).unit("time")});
}

}  // namespace

TagSpec fixed_values_tag() {
  return tag("MassMomEng_src", "mass, momentum and energy sources of a material in regions")
      .with_children(
          {tag("material", "name of the material").once().text(),
           tag("sources", "the regions")
               .once()
               .child(tag("geom_object", "a region; the last one holds where regions overlap")
                          .at_least_once()
                          .attribute(attribute("name", "name of the region").text())
                          .group("geometry_piece")
                          .child(algorithm()))});
}

void check_fixed_values(const DeckNode& parameters, const std::vector<std::string>& materials,
                        std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  const DeckNode* sources = parameters.child("sources");
  if (sources == nullptr) return;
  for (const DeckNode* object : sources->all("geom_object")) {
    if (std::none_of(object->children.begin(), object->children.end(),
                     [](const auto& child) { return is_geometry_piece(child->name); }))
      add_error(faults, object->where, "<geom_object> has no geometry piece",
                "add a <box>, <sphere>, ...; see sluice help geom_object");
    const DeckNode* algorithm = object->child("algorithm");
    const auto start = real_of(algorithm, "timeStart"), stop = real_of(algorithm, "timeStop");
    if (start && stop && *start >= *stop)
      add_error(faults, algorithm->child("timeStop")->where,
                fmt::format("timeStop {:g} is not after timeStart {:g}: the source never acts",
                            *stop, *start));
  }
}

std::vector<FixedValues> read_fixed_values(const DeckNode& parameters,
                                           const std::vector<std::string>& materials,
                                           const GeometryReader& geometry,
                                           std::vector<Fault>& faults) {
  std::vector<FixedValues> list;
  for (const DeckNode* object : parameters.child("sources")->all("geom_object")) {
    const DeckNode& algorithm = *object->child("algorithm");
    FixedValues v;
    v.material = read_material(parameters, "material", materials);
    v.region = geometry.object(*object, faults).piece;
    v.density = algorithm.real("density_src");
    v.velocity = algorithm.child("velocity_src")->as_vector();
    v.temperature = algorithm.real("temperature_src");
    v.when.start = real_or(algorithm, "timeStart", 0);
    v.when.stop = real_or(algorithm, "timeStop", v.when.stop);
    v.where = object->where;
    list.push_back(std::move(v));
  }
  return list;
}

}  // namespace sluice::models
