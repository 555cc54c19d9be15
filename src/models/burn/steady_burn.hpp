// Model "Steady_Burn": the surface of a solid burns as Ward, Son and Brewster have it.
//
// Zero-order decomposition in the solid, an energetic reaction in the gas without activation
// energy; with the surface at T_s, the solid far from it at T_0:
//   m(T_s)^2 = C1 T_s^2 exp(-E_c/(R T_s))/(T_s - C2)
//   T_s = F(T_s) = C4 + C5/(sqrt(m^2 + C3) + m)^2
//   C1 = A_c R K_c rho/(E_c c_p),  C2 = T_0 + Q_c/(2 c_p),  C3 = 4 K_g B_g W^2 p^2/(c_p R^2),
//   C4 = T_0 + Q_c/c_p,            C5 = C3 Q_g/c_p
// (Ward, Son, Brewster, Combust. Flame 114 (1998) 556.) m rises with T_s above C2 up to a highest
// point, F falls where m rises: the root lies between C4 and the F of that point.
#pragma once
#include <memory>
#include <vector>

#include "models/burn/burn_law.hpp"
#include "models/deck/reactant.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct SteadyBurn {
  double gas_constant = 8.314;                              // R, J/(K mol)
  double solid_rate = 0, activation = 1;                    // A_c, 1/s; E_c, J/mol
  double gas_rate = 0;                                      // B_g, m^3/(kg s K)
  double solid_heat = 0, gas_heat = 0;                      // Q_c, Q_g, J/kg
  double gas_conductivity = 0, conductivity = 0;            // K_g, K_c, W/(m K)
  double specific_heat = 1;                                 // c_p, J/(kg K)
  double molar_mass = 1;                                    // W, kg/mol
  double threshold_pressure = 0, ignition_temperature = 0;  // Pa, K

  double heat() const { return solid_heat + gas_heat; }
  bool burns(double pressure, double hottest) const {
    return pressure >= threshold_pressure && hottest > ignition_temperature;
  }
  // As the laws of surface and flame have it: no flux where the surface does not burn.
  BurningSurface steady_surface(const AtSurface& at) const {
    if (!burns(at.pressure, at.hottest)) return {};
    return surface(at.pressure, at.solid_temperature, at.density);
  }
  // At a pressure (Pa), for a solid of this temperature (K) and density (kg/m^3).
  BurningSurface surface(double pressure, double solid_temperature, double density) const;
};

// Its parameters, which models of the same surface and flame share.
// `threshold`: what that of the pressure is called.
std::vector<TagSpec> surface_and_flame_tags(const char* threshold = "ThresholdPressure");
SteadyBurn read_surface_and_flame(const DeckNode& parameters,
                                  const char* threshold = "ThresholdPressure");
TagSpec steady_burn_tag();
std::shared_ptr<const BurnLaw> read_steady_burn(const DeckNode& parameters,
                                                const MaterialNames& names);

}  // namespace sluice::models
