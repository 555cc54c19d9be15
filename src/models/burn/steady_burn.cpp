// Model "Steady_Burn": the temperature of the surface, and how a deck says it.
#include "models/burn/steady_burn.hpp"

#include <algorithm>
#include <cmath>

#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::models {
namespace {

constexpr int max_iterations = 200;
constexpr double tolerance = 1e-12;  // of T_s, relative

struct Constants {
  double C1, C2, C3, C4, C5, E_over_R;

  // 0 at and below C2, where the law has no state.
  double flux(double T) const {
    if (!(T > C2)) return 0.0;
    return std::sqrt(C1 * T * T * std::exp(-E_over_R / T) / (T - C2));
  }
  double image(double m) const {
    const double s = std::sqrt(m * m + C3) + m;
    return C4 + C5 / (s * s);
  }
};

}  // namespace

BurningSurface SteadyBurn::surface(double p, double T0, double density) const {
  const double q = solid_heat / specific_heat, R = gas_constant;
  Constants k{};
  k.C1 = solid_rate * R * conductivity * density / (activation * specific_heat);
  k.C2 = T0 + 0.5 * q;
  k.C3 =
      4 * gas_conductivity * gas_rate * molar_mass * molar_mass * p * p / (specific_heat * R * R);
  k.C4 = T0 + q;
  k.C5 = gas_heat / specific_heat * k.C3;
  k.E_over_R = activation / R;
  // m falls from C2 on to its lowest point, where 2/T + E/(R T^2) = 1/(T - C2), and rises beyond:
  // there F is at its highest, and T - F(T) is monotone from C4 to that value.
  const double a = k.C2 - 0.5 * k.E_over_R;
  const double turn = a + std::sqrt(a * a + k.E_over_R * k.C2);
  double low = k.C4, high = k.image(k.flux(std::max(k.C4, turn)));
  if (!(high > low)) return {low, k.flux(low)};
  double T = 0.5 * (low + high);
  for (int i = 0; i < max_iterations && high - low > tolerance * high; ++i) {
    (T < k.image(k.flux(T)) ? low : high) = T;
    T = 0.5 * (low + high);
  }
  return {T, k.flux(T)};
}

std::vector<TagSpec> surface_and_flame_tags(const char* threshold) {
  const auto number = [](const char* name, const char* text, const char* unit) {
    return tag(name, text).once().real().at_least(0).unit(unit);
  };
  const auto positive = [](const char* name, const char* text, const char* unit) {
    return tag(name, text).once().real().above(0).unit(unit);
  };
  return {tag("fromMaterial", "name of the solid that burns").once().text(),
          tag("toMaterial", "name of the fluid that is produced").once().text(),
          tag("Active", "accepted without effect").boolean(),
          positive("IdealGasConst", "gas constant", "energy/(K mol)"),
          number("PreExpCondPh", "rate of the reaction in the solid, A_c", "1/time"),
          positive("ActEnergyCondPh", "activation energy of the reaction in the solid, E_c",
                   "energy/mol"),
          number("PreExpGasPh", "rate of the reaction in the gas, B_g", "m^3/(kg s K)"),
          number("CondPhaseHeat", "heat of the reaction in the solid, Q_c", "energy/mass"),
          number("GasPhaseHeat", "heat of the reaction in the gas, Q_g", "energy/mass"),
          positive("HeatConductGasPh", "conductivity of the gas, K_g", "W/(m K)"),
          positive("HeatConductCondPh", "conductivity of the solid, K_c", "W/(m K)"),
          positive("SpecificHeatBoth", "specific heat of solid and gas, c_p", "energy/(mass K)"),
          positive("MoleWeightGasPh", "molar mass of the gas, W", "kg/mol"),
          tag("BoundaryParticles",
              "accepted without effect: the faces of particles on the surface are known")
              .real()
              .at_least(0),
          number(threshold, "burns at this pressure and above", "pressure"),
          number("IgnitionTemp",
                 "burns where the fluid at the surface or around it, or the solid, is hotter than "
                 "this",
                 "temperature")};
}

TagSpec steady_burn_tag() {
  return tag("Steady_Burn", "surface of a solid burns by the model of Ward, Son and Brewster")
      .with_children(surface_and_flame_tags());
}

SteadyBurn read_surface_and_flame(const DeckNode& parameters, const char* threshold) {
  SteadyBurn m;
  m.gas_constant = parameters.real("IdealGasConst");
  m.solid_rate = parameters.real("PreExpCondPh");
  m.activation = parameters.real("ActEnergyCondPh");
  m.gas_rate = parameters.real("PreExpGasPh");
  m.solid_heat = parameters.real("CondPhaseHeat");
  m.gas_heat = parameters.real("GasPhaseHeat");
  m.gas_conductivity = parameters.real("HeatConductGasPh");
  m.conductivity = parameters.real("HeatConductCondPh");
  m.specific_heat = parameters.real("SpecificHeatBoth");
  m.molar_mass = parameters.real("MoleWeightGasPh");
  m.threshold_pressure = parameters.real(threshold);
  m.ignition_temperature = parameters.real("IgnitionTemp");
  return m;
}

namespace {

class SteadyBurnLaw final : public SurfaceLaw {
 public:
  explicit SteadyBurnLaw(const SteadyBurn& law) : law_(law) {}
  double heat_of_reaction() const override { return law_.heat(); }
  std::vector<BurningOutput> outputs() const override {
    return {{BurningValue::burns, "SteadyBurn.BurningCell"}};
  }
  bool looks_around() const override { return true; }
  BurningSurface steady_surface(const AtSurface& at) const override {
    return law_.steady_surface(at);
  }
  const SurfaceDelay* delay() const override { return nullptr; }

 private:
  SteadyBurn law_;
};

}  // namespace

std::shared_ptr<const BurnLaw> read_steady_burn(const DeckNode& parameters,
                                                const MaterialNames& /*names*/) {
  return std::make_shared<SteadyBurnLaw>(read_surface_and_flame(parameters));
}

}  // namespace sluice::models
