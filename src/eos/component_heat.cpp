// Table of species and the mixing rule.
#include "eos/component_heat.hpp"

#include <cmath>
#include <string>

#include "framework/base/error.hpp"

namespace sluice::eos {
namespace {

struct Species {
  const char* name;
  double MoleFractions::*fraction;
  double molar_mass;  // g/mol
  Nasa7Heat::Coefficients low, high;
};

constexpr Species table[] = {
    {"CO2",
     &MoleFractions::CO2,
     44.009,
     {2.3568130, 8.9841299e-3, -7.1220632e-6, 2.4573008e-9, -1.4288548e-13},
     {4.6365111, 2.7414569e-3, -9.9589759e-7, 1.6038666e-10, -9.1619857e-15}},
    {"CO",
     &MoleFractions::CO,
     28.010,
     {3.5795335, -6.1035369e-4, 1.0168143e-6, 9.0700586e-10, -9.0442449e-13},
     {3.0484859, 1.3517281e-3, -4.8579405e-7, 7.8853644e-11, -4.6980746e-15}},
    {"H2O",
     &MoleFractions::H2O,
     18.015,
     {4.1986352, -2.0364017e-3, 6.5203416e-6, -5.4879269e-9, 1.7719680e-12},
     {2.6770389, 2.9731816e-3, -7.7376889e-7, 9.4433514e-11, -4.2689991e-15}},
    {"O2",
     &MoleFractions::O2,
     31.998,
     {3.78245636, -2.99673415e-3, 9.84730200e-6, -9.68129508e-9, 3.24372836e-12},
     {3.66096083, 6.56365523e-4, -1.41149485e-7, 2.05797658e-11, -1.29913248e-15}},
    {"N2",
     &MoleFractions::N2,
     28.014,
     {3.53100528, -1.23660988e-4, -5.02999433e-7, 2.43530612e-9, -1.40881235e-12},
     {2.95257637, 1.39690040e-3, -4.92631603e-7, 7.86010195e-11, -4.60755204e-15}},
    {"OH",
     &MoleFractions::OH,
     17.007,
     {3.99201543, -2.40131752e-3, 4.61793841e-6, -3.88113333e-9, 1.36411470e-12},
     {2.83864607, 1.10725586e-3, -2.93914978e-7, 4.20524247e-11, -2.42169092e-15}},
    {"NO",
     &MoleFractions::NO,
     30.006,
     {4.21859896, -4.63988124e-3, 1.10443049e-5, -9.34055507e-9, 2.80554874e-12},
     {3.26071234, 1.19101135e-3, -4.29122646e-7, 6.94481463e-11, -4.03295681e-15}},
    {"O",
     &MoleFractions::O,
     15.999,
     {3.16826710, -3.27931884e-3, 6.64306396e-6, -6.12806624e-9, 2.11265971e-12},
     {2.54363697, -2.73162486e-5, -4.19029520e-9, 4.95481845e-12, -4.79553694e-16}},
    {"H", &MoleFractions::H, 1.008, {2.5, 0, 0, 0, 0}, {2.5, 0, 0, 0, 0}},
    {"H2",
     &MoleFractions::H2,
     2.016,
     {2.3443029, 7.9804248e-3, -1.9477917e-5, 2.0156967e-8, -7.3760289e-12},
     {2.9328305, 8.2659802e-4, -1.4640057e-7, 1.5409851e-11, -6.8879615e-16}},
};

void check(const MoleFractions& x) {
  double sum = 0.0;
  for (const Species& s : table) {
    const double part = x.*s.fraction;
    sum += part;
    if (!(part >= 0.0 && part <= 1.0))
      throw InputError("mole fraction of " + std::string(s.name) + " is " + std::to_string(part) +
                       "; it must lie between 0 and 1");
  }
  if (!(std::abs(sum - 1.0) <= 1e-9))
    throw InputError("mole fractions of a Component specific heat sum to " + std::to_string(sum) +
                     "; they must sum to 1 (species left out count as 0)");
}

}  // namespace

double molar_mass(const MoleFractions& x) {
  double sum = 0.0;
  for (const Species& s : table) sum += x.*s.fraction * s.molar_mass;
  return 1e-3 * sum;
}

Nasa7Heat component_heat(const MoleFractions& x) {
  check(x);
  Nasa7Heat mixture{.gas_constant = molar_gas_constant / molar_mass(x), .low = {}, .high = {}};
  for (const Species& s : table)
    for (std::size_t k = 0; k < 5; ++k) {
      mixture.low[k] += x.*s.fraction * s.low[k];
      mixture.high[k] += x.*s.fraction * s.high[k];
    }
  return mixture;
}

Nasa7Heat air_heat(double gas_constant) {
  Nasa7Heat air = component_heat({.O2 = 1.0 / 4.76, .N2 = 3.76 / 4.76});
  air.gas_constant = gas_constant;
  return air;
}

}  // namespace sluice::eos
