// Model "Test": its law, and how a deck says it.
#include "models/mass_exchange.hpp"

#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/material_name.hpp"

namespace sluice::models {

double MassExchange::share(double time, double dt) const {
  return -std::expm1(-rate * when.overlap(time, dt));
}

TagSpec mass_exchange_tag() {
  return tag("Test", "mass of one material becomes another's at a constant rate")
      .with_children(
          {tag("fromMaterial", "name of the material that gives its mass").once().text(),
           tag("toMaterial",
               "name of the material that gets it, with its momentum, energy and "
               "volume")
               .once()
               .text(),
           tag("rate", "share of the mass that passes, m' = -rate m")
               .once()
               .real()
               .at_least(0)
               .unit("1/time"),
           tag("startTime", "from when on").real().at_least(0).unit("time").by_default("0")});
}

void check_mass_exchange(const DeckNode& parameters, const std::vector<std::string>& materials,
                         std::vector<Fault>& faults) {
  const auto from = check_material(parameters, "fromMaterial", materials, faults);
  const auto to = check_material(parameters, "toMaterial", materials, faults);
  if (from && to && *from == *to)
    add_error(faults, parameters.child("toMaterial")->where,
              "<toMaterial> is <fromMaterial>: nothing would pass", "name two materials");
}

MassExchange read_mass_exchange(const DeckNode& parameters,
                                const std::vector<std::string>& materials) {
  MassExchange m;
  m.from = read_material(parameters, "fromMaterial", materials);
  m.to = read_material(parameters, "toMaterial", materials);
  m.rate = parameters.real("rate");
  m.when.start = real_or(parameters, "startTime", 0);
  m.where = parameters.where;
  return m;
}

}  // namespace sluice::models
