// Model "Simple_Burn": how a deck says it.
#include "models/burn/simple_burn.hpp"

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec simple_burn_tag() {
  return tag("Simple_Burn", "surface of a solid burns: mass flux A (p/p_ref)^0.778")
      .with_children({tag("fromMaterial", "name of the solid that burns").once().text(),
                      tag("toMaterial",
                          "name of the fluid that it becomes, with its momentum, energy and volume")
                          .once()
                          .text(),
                      tag("Active", "accepted without effect").boolean(),
                      tag("ThresholdTemp",
                          "burns where the fluid at the surface, or the solid, is hotter than this")
                          .once()
                          .real()
                          .at_least(0)
                          .unit("temperature"),
                      tag("ThresholdPressure", "burns above this pressure")
                          .once()
                          .real()
                          .at_least(0)
                          .unit("pressure"),
                      tag("Enthalpy", "heat of the reaction per mass, given to the product")
                          .once()
                          .real()
                          .unit("energy/mass"),
                      tag("BurnCoeff", "mass flux at the reference pressure")
                          .once()
                          .real()
                          .at_least(0)
                          .unit("mass/(area time)"),
                      tag("refPressure", "pressure of that mass flux")
                          .once()
                          .real()
                          .above(0)
                          .unit("pressure")});
}

SimpleBurn read_simple_burn(const DeckNode& parameters, const MaterialNames& /*names*/) {
  SimpleBurn m;
  m.threshold_temperature = parameters.real("ThresholdTemp");
  m.threshold_pressure = parameters.real("ThresholdPressure");
  m.heat = parameters.real("Enthalpy");
  m.coefficient = parameters.real("BurnCoeff");
  m.reference_pressure = parameters.real("refPressure");
  return m;
}

}  // namespace sluice::models
