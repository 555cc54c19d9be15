// Model "Simple_Burn": how a deck says it.
#include "models/burn/simple_burn.hpp"

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {

TagSpec simple_burn_tag() {
  return tag("Simple_Burn", "surface of a solid burns: mass flux A (p/p_ref)^0.778")
      .with_children(
          {tag("fromMaterial", "name of the solid that burns").once().text(),
           tag("toMaterial",
               "name of the fluid that is produced, with its momentum, energy and volume")
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

namespace {

class SimpleBurnLaw final : public SurfaceLaw {
 public:
  explicit SimpleBurnLaw(const SimpleBurn& law) : law_(law) {}
  double heat_of_reaction() const override { return law_.heat; }
  std::vector<BurningOutput> outputs() const override { return {}; }
  bool looks_around() const override { return false; }
  BurningSurface steady_surface(const AtSurface& at) const override {
    if (!law_.burns(at.pressure, at.hottest)) return {};
    return {0, law_.flux(at.pressure)};
  }
  const SurfaceDelay* delay() const override { return nullptr; }

 private:
  SimpleBurn law_;
};

}  // namespace

std::shared_ptr<const BurnLaw> read_simple_burn(const DeckNode& parameters,
                                                const MaterialNames& /*names*/) {
  SimpleBurn m;
  m.threshold_temperature = parameters.real("ThresholdTemp");
  m.threshold_pressure = parameters.real("ThresholdPressure");
  m.heat = parameters.real("Enthalpy");
  m.coefficient = parameters.real("BurnCoeff");
  m.reference_pressure = parameters.real("refPressure");
  return std::make_shared<SimpleBurnLaw>(m);
}

}  // namespace sluice::models
