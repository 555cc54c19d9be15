// Specific heats: energy is the integral of cv, temperature inverts it, published values.
#include <vector>

#include "eos/constant_heat.hpp"
#include "eos/debye_heat.hpp"
#include "eos/eos_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::eos::specific_heat_test {
namespace {

// e' = cv by differences (away from the joints of the ranges), T(e(T)) = T, cv > 0, e(0) = 0.
template <class Heat>
void check_heat(const Heat& heat, double low, double high, const std::vector<double>& joints = {}) {
  EXPECT_EQ(heat.energy(0.0), 0.0);
  double last = 0.0;
  for (double T = low; T < high; T *= 1.0173) {
    const double e = heat.energy(T), cv = heat.specific_heat(T), h = 1e-3 * T;
    EXPECT_GT(e, last) << T;
    last = e;
    EXPECT_GT(cv, 0.0) << T;
    EXPECT_NEAR(heat.temperature(e), T, 1e-11 * T + 1e-13 * e / cv);
    bool joint = false;
    for (const double t : joints) joint = joint || std::abs(T - t) < 3 * h;
    if (joint) continue;
    const double slope = slope_of([&](double x) { return heat.energy(x); }, T, h);
    EXPECT_NEAR(slope, cv, 1e-8 * cv) << T;
  }
}

TEST(ConstantHeat, IsConsistent) {
  check_heat(ConstantHeat{717.5}, 1.0, 1e5);
}

TEST(DebyeHeat, IsConsistent) {
  check_heat(DebyeHeat{.atoms_per_mass = 9.48e24, .debye_temperature = 343.0}, 2.0, 1e5);
}

// D(1) of Abramowitz and Stegun, table 27.1; cv/(3 N k) of the usual tables (Gopal, Specific Heats
// at Low Temperatures, 1966, appendix); T^3 law; Dulong and Petit.
TEST(DebyeHeat, GivesTabulatedValues) {
  EXPECT_NEAR(debye_function(1.0), 0.674416, 5e-7);
  EXPECT_NEAR(debye_function(2.0 - 1e-12), debye_function(2.0), 1e-12);
  const DebyeHeat crystal{.atoms_per_mass = 1e25, .debye_temperature = 400.0};
  const auto share = [&](double t) { return crystal.specific_heat(400.0 * t) / crystal.limit(); };
  EXPECT_NEAR(share(1.0), 0.952, 5e-4);
  EXPECT_NEAR(share(0.5), 0.825, 5e-4);
  EXPECT_NEAR(share(0.25), 0.503, 5e-4);
  EXPECT_NEAR(share(0.1), 0.0758, 5e-5);
  EXPECT_NEAR(share(0.01), 0.8 * std::pow(std::numbers::pi, 4) * 1e-6, 1e-15);
  EXPECT_NEAR(share(100.0), 1.0, 1e-5);
  EXPECT_EQ(crystal.specific_heat(0.0), 0.0);
}

TEST(ComponentHeat, IsConsistent) {
  check_heat(component_heat({.CO2 = 0.2, .CO = 0.2, .H2O = 0.2, .N2 = 0.3, .OH = 0.1}), 20.0, 2e4,
             {200.0, 1000.0, 6000.0});
  check_heat(component_heat({.NO = 0.25, .O = 0.25, .H = 0.25, .H2 = 0.25}), 20.0, 2e4,
             {200.0, 1000.0, 6000.0});
}

// cp of JANAF (Chase 1998), J/(mol K), at 300, 1000 (both ranges) and 3000 K; monatomic H: 5/2 R.
// The polynomials of H2O and OH rest on later spectroscopic data, hence their own share at 3000 K.
TEST(ComponentHeat, GivesTheValuesOfJanaf) {
  const auto cp = [](const MoleFractions& x, double T) {
    const Nasa7Heat heat = component_heat(x);
    return molar_mass(x) * (heat.specific_heat(T) + heat.gas_constant);
  };
  struct Row {
    MoleFractions x;
    double at_300, at_1000, at_3000;
    double share = 5e-3;
  };
  const Row rows[] = {
      {{.CO2 = 1}, 37.221, 54.308, 62.229},       {{.CO = 1}, 29.142, 33.183, 37.217},
      {{.H2O = 1}, 33.596, 41.268, 55.748, 2e-2}, {{.O2 = 1}, 29.385, 34.870, 39.884},
      {{.N2 = 1}, 29.125, 32.697, 37.030},        {{.OH = 1}, 29.977, 30.676, 36.838, 1e-2},
      {{.NO = 1}, 29.841, 33.987, 37.466},        {{.O = 1}, 21.901, 20.915, 20.937},
      {{.H = 1}, 20.786, 20.786, 20.786},         {{.H2 = 1}, 28.849, 30.205, 37.087}};
  for (const Row& row : rows) {
    EXPECT_NEAR(cp(row.x, 300.0), row.at_300, 5e-3 * row.at_300);
    EXPECT_NEAR(cp(row.x, 1000.0), row.at_1000, 3e-3 * row.at_1000);
    EXPECT_NEAR(cp(row.x, 1000.0 - 1e-9), row.at_1000, 3e-3 * row.at_1000);
    EXPECT_NEAR(cp(row.x, 3000.0), row.at_3000, row.share * row.at_3000);
  }
}

TEST(ComponentHeat, RefusesFractionsThatDoNotSumToOne) {
  EXPECT_THROW(component_heat({.O2 = 0.2, .N2 = 0.7}), InputError);
  EXPECT_THROW(component_heat({.O2 = -0.2, .N2 = 1.2}), InputError);
  EXPECT_THROW(component_heat({}), InputError);
}

TEST(AirHeat, GivesTheSpecificHeatOfAir) {  // cp 1005 at 300 K, 1141 at 1000 K
  const Nasa7Heat air = air_heat(287.0);
  EXPECT_NEAR(air.specific_heat(300.0) + 287.0, 1005.0, 8.0);
  EXPECT_NEAR(air.specific_heat(1000.0) + 287.0, 1141.0, 9.0);
}

// Products of HMX, as the decks give them.
const double hmx[] = {-8.330700e14, 1.811170e14, -1.426913e13, 5.305770e11,
                      -9.958630e9,  9.237480e7,  -3.85805e5,   1476.8};

TEST(PolynomialHeat, IsConsistent) {
  const PolynomialHeat heat = polynomial_heat(hmx, 7, 250.0, 1e6);
  check_heat(heat, 100.0, 1e5, {250.0});
  EXPECT_NEAR(heat.specific_heat(1000.0), 1173.9, 0.1);
  EXPECT_NEAR(heat.specific_heat(1e6), 1476.4, 0.1);
}

TEST(PolynomialHeat, RefusesBadCoefficients) {
  EXPECT_THROW(polynomial_heat(hmx, 6, 250.0, 1e6), InputError);   // one too many
  EXPECT_THROW(polynomial_heat(hmx, 12, 250.0, 1e6), InputError);  // order too high
  EXPECT_THROW(polynomial_heat(hmx, 7, 0.0, 1e6), InputError);     // 1/T at 0 K
  EXPECT_THROW(polynomial_heat(hmx, 7, 10.0, 1e6), InputError);    // negative below 100 K
  EXPECT_THROW(polynomial_heat(hmx, 7, 300.0, 200.0), InputError);
}

}  // namespace
}  // namespace sluice::eos::specific_heat_test
