// Model "JWLpp" (JWL++): an explosive becomes its products, by pressure, wherever it is.
//
//   dF/dt = G (1 - F) p^b,  F = m_q/(m_r + m_q): the burned share of a cell,
// above a pressure and a volume fraction of the reactant, until F = 0.99. What burns in a step
// is at most the reactant, and 0.2 of what the cell would hold unburned. Heat: E0 per mass.
// (Souers, Anderson, Mercer, McGuire and Vitello, Propellants Explos. Pyrotech. 25 (2000) 54.)
#pragma once
#include <algorithm>
#include <cmath>

#include "framework/deck/deck.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct JwlPp {
  static constexpr double max_in_a_step = 0.2;  // of rho0 times the volume of the cell

  double max_burned = 0.99;       // F
  double threshold_pressure = 0;  // Pa
  double min_volume_fraction = 0.01;
  double G = 0, b = 1;  // 1/(s Pa^b)
  double heat = 0;      // J/kg
  double rho0 = 1;      // kg/m^3

  // Burned share of reactant and product; masses per volume of the cell, kg/m^3.
  static double share(double reactant_mass, double product_mass) {
    const double all = reactant_mass + product_mass;
    return all > 0 ? product_mass / all : 0.0;
  }
  bool burns(double pressure, double volume_fraction) const {
    return pressure > threshold_pressure && volume_fraction > min_volume_fraction;
  }
  // Mass per volume of the cell, kg/m^3, that burns in dt (s) at a pressure (Pa): the step of the
  // law solved exactly for constant p, 1 - F' = (1 - F) exp(-G p^b dt).
  double burned(double dt, double pressure, double reactant_mass, double product_mass) const {
    if (!(share(reactant_mass, product_mass) < max_burned)) return 0.0;
    const double all = reactant_mass * -std::expm1(-G * std::pow(pressure, b) * dt);
    return std::min(all, max_in_a_step * rho0);
  }
};

TagSpec jwlpp_tag();
JwlPp read_jwlpp_law(const DeckNode& parameters);

}  // namespace sluice::models
