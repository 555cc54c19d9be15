// Model "Unsteady_Burn": what a surface remembers, and how a deck says it.
#include "models/burn/unsteady_burn.hpp"

#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {
namespace {

// Of y' = (target - y)/tau, over dt: exact while the target stays.
double relaxed(double y, double target, double dt, double tau) {
  return tau > 0 ? target + (y - target) * std::exp(-dt / tau) : target;
}

}  // namespace

SurfaceHistory UnsteadyBurn::after(double dt, const SurfaceHistory& before,
                                   const BurningSurface& steady, double solid_temperature,
                                   double density) const {
  const double m = steady.flux;
  const double gradient =
      (steady.temperature - solid_temperature) * m * specific_heat / conductivity;
  if (!before.lit()) return {steady.temperature, gradient};
  const double tau = solid_delay * conductivity * density / (specific_heat * m * m);
  return {relaxed(before.temperature, steady.temperature, dt, gas_delay * tau),
          relaxed(before.gradient, gradient, dt, tau)};
}

double UnsteadyBurn::flux(const SurfaceHistory& now, double steady_flux, double density) const {
  const double T = now.temperature, R = gas_constant;
  const double conducted = conductivity * now.gradient;
  const double reaction = solid_rate * R * conductivity * density / activation * T * T *
                          std::exp(-activation / (R * T));
  const double under_root = conducted * conducted - 2 * solid_heat * reaction;
  const double m =
      under_root > 0 ? 2 * reaction / (conducted + std::sqrt(under_root)) : conducted / solid_heat;
  return steady_flux * std::pow(m / steady_flux, rate_power);
}

TagSpec unsteady_burn_tag() {
  const auto coefficient = [](const char* name, const char* text) {
    return tag(name, text).once().real().at_least(0);
  };
  return tag("Unsteady_Burn",
             "surface of a solid burns as with Steady_Burn, and follows changes of pressure with a "
             "delay")
      .with_children(surface_and_flame_tags())
      .with_children(
          {coefficient("BurnrateModCoef", "exponent of the ratio of unsteady to steady rate, B_m"),
           coefficient("CondUnsteadyCoef",
                       "delay of the gradient in the solid, in K_c rho/(c_p m^2), N_c"),
           coefficient("GasUnsteadyCoef",
                       "delay of the surface temperature, in units of that of the gradient, N_g")});
}

namespace {

class UnsteadyBurnLaw final : public SurfaceLaw, private SurfaceDelay {
 public:
  explicit UnsteadyBurnLaw(const UnsteadyBurn& law) : law_(law) {}
  double heat_of_reaction() const override { return law_.heat(); }
  std::vector<BurningOutput> outputs() const override {
    return {{BurningValue::burns, "UnsteadyBurn.BurningCell"},
            {BurningValue::temperature, "UnsteadyBurn.SurfTemp"},
            {BurningValue::gradient, "UnsteadyBurn.SurfTempGrad"}};
  }
  bool looks_around() const override { return true; }
  BurningSurface steady_surface(const AtSurface& at) const override {
    return law_.steady_surface(at);
  }
  const SurfaceDelay* delay() const override { return this; }

 private:
  SurfaceHistory after(double dt, const SurfaceHistory& before, const BurningSurface& steady,
                       double solid_temperature, double density) const override {
    return law_.after(dt, before, steady, solid_temperature, density);
  }
  double flux(const SurfaceHistory& now, double steady_flux, double density) const override {
    return law_.flux(now, steady_flux, density);
  }

  UnsteadyBurn law_;
};

}  // namespace

std::shared_ptr<const BurnLaw> read_unsteady_burn(const DeckNode& parameters,
                                                  const MaterialNames& /*names*/) {
  UnsteadyBurn m{read_surface_and_flame(parameters)};
  m.rate_power = parameters.real("BurnrateModCoef");
  m.solid_delay = parameters.real("CondUnsteadyCoef");
  m.gas_delay = parameters.real("GasUnsteadyCoef");
  return std::make_shared<UnsteadyBurnLaw>(m);
}

}  // namespace sluice::models
