// Specific heat of gas mixtures of ten species, and of air, from NASA polynomials (nasa7_heat.hpp).
//
// The polynomials of all species share their ranges (200, 1000, 6000 K), so a mixture is again one
// polynomial: the mean weighted by mole fractions, with the gas constant of the mean molar mass.
// Coefficients: McBride, Gordon and Reno, NASA TM-4513 (1993), and Burcat's data base (N2).
#pragma once
#include "eos/nasa7_heat.hpp"

namespace sluice::eos {

inline constexpr double molar_gas_constant = 8.31446261815324;  // J/(mol K)

// Shares from 0 to 1.
struct MoleFractions {
  double CO2 = 0, CO = 0, H2O = 0, O2 = 0, N2 = 0, OH = 0, NO = 0, O = 0, H = 0, H2 = 0;
};

// InputError unless all fractions lie in [0, 1] and sum to 1 (to 1e-9).
Nasa7Heat component_heat(const MoleFractions& x);
double molar_mass(const MoleFractions& x);  // kg/mol

// Air as 3.76 mol N2 per mol O2, with the gas constant of the deck, J/(kg K).
Nasa7Heat air_heat(double gas_constant);

}  // namespace sluice::eos
