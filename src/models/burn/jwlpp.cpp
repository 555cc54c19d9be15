// Model "JWLpp": how a deck says it.
#include "models/burn/jwlpp.hpp"

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec jwlpp_tag() {
  return tag("JWLpp", "JWL++: an explosive becomes its products, dF/dt = G (1 - F) p^b")
      .with_children(
          {tag("fromMaterial", "name of the explosive, a fluid or a solid").once().text(),
           tag("toMaterial", "name of the fluid that the reaction products form").once().text(),
           tag("Active", "accepted without effect").boolean(),
           tag("ThresholdPressure", "burns above this pressure")
               .once()
               .real()
               .at_least(0)
               .unit("pressure"),
           tag("ThresholdVolFrac",
               "burns where the explosive fills more than this fraction of a cell")
               .real()
               .at_least(0)
               .at_most(1)
               .by_default("0.01"),
           tag("G", "rate, with the pressure in the deck's units").once().real().at_least(0),
           tag("b", "exponent of the pressure").once().real().at_least(0),
           tag("E0", "heat of the reaction per mass, given to the product")
               .once()
               .real()
               .unit("energy/mass"),
           tag("rho0", "initial density of the explosive: a step burns at most a fifth of it")
               .once()
               .real()
               .above(0)
               .unit("density")});
}

JwlPp read_jwlpp_law(const DeckNode& parameters) {
  JwlPp m;
  m.threshold_pressure = parameters.real("ThresholdPressure");
  m.min_volume_fraction = real_or(parameters, "ThresholdVolFrac", m.min_volume_fraction);
  m.G = parameters.real("G");
  m.b = parameters.real("b");
  m.heat = parameters.real("E0");
  m.rho0 = parameters.real("rho0");
  return m;
}

}  // namespace sluice::models
