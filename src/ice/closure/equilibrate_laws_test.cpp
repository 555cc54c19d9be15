// One pressure for every pair of laws, from traces to halves, pressures decades apart.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "eos/eos_test_support.hpp"
#include "ice/closure/equilibrate.hpp"

namespace sluice::ice::mixture::equilibrate_laws_test {
namespace {

struct Range {
  double p_low, p_high, T_low, T_high;  // Pa, K
};

// Water with a density maximum is a fit to about 1e8 Pa and 40 C.
Range range_of(const eos::EquationOfState& law) {
  if (std::holds_alternative<eos::ThomsenHartkaWater>(law)) return {1e5, 1e8, 283, 313};
  return {1e5, 1e10, 290, 590};
}

class AnyCell {
 public:
  AnyCell(const Fluid& a, const Fluid& b)
      : fluids_{a, b}, ranges_{range_of(a.law), range_of(b.law)} {}

  // Volumes of 1e-12 and more, pressures up to `ratio` apart. False: the laws have no such state.
  bool draw(double ratio, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const auto between = [&](double low, double high) {
      return low * std::pow(high / low, unit(random));
    };
    const double p = between(1e5, std::fmin(ranges_[0].p_high, ranges_[1].p_high) / ratio);
    const double small = between(1e-12, 0.5);
    const int of_small = unit(random) < 0.5 ? 0 : 1;
    bool good = true;
    for (int m = 0; m < 2; ++m) {
      const double T = between(ranges_[m].T_low, ranges_[m].T_high);
      const double rho = fluids_[m].density(p * between(1, ratio), T);
      const double rho_e = fluids_[m].energy_from_temperature(rho, T);
      V[m] = m == of_small ? small : 1 - small;
      M[m] = V[m] * rho;
      E[m] = V[m] * rho_e;
      good = good && fluids_[m].admissible(rho, rho_e);
    }
    return good;
  }
  // The largest |p_m - q| of both, as a share of their moduli.
  double apart(double q) const {
    double most = 0;
    for (int m = 0; m < 2; ++m) {
      const double rho = M[m] / V[m], p = fluids_[m].pressure(rho, E[m] / V[m]);
      most = std::fmax(most, std::fabs(p - q) / fluids_[m].modulus_of_state(rho, E[m] / V[m]));
    }
    return most;
  }

  double M[2], V[2], E[2];

 private:
  Fluid fluids_[2];
  Range ranges_[2];
};

class EquilibrationOfLaws : public testing::TestWithParam<double> {};

TEST_P(EquilibrationOfLaws, FindsOnePressureOfEveryPair) {
  constexpr int draws = 40;
  constexpr double min_drawn = 0.9, limit = 1e-12;
  const std::vector<eos::EquationOfState> laws = eos::one_of_each();
  std::mt19937_64 random(20261122);
  int drawn = 0, pairs = 0;
  for (std::size_t a = 0; a < laws.size(); ++a)
    for (std::size_t b = a; b < laws.size(); ++b, ++pairs) {
      const Fluid first{laws[a], std::nullopt, 1.4, 1000}, second{laws[b], std::nullopt, 1.4, 1000};
      const Equilibration equilibration({first, second});
      AnyCell cell(first, second);
      for (int n = 0; n < draws; ++n) {
        if (!cell.draw(GetParam(), random)) continue;
        ++drawn;
        SCOPED_TRACE(testing::Message() << "laws " << a << " and " << b << ", volume of the first "
                                        << cell.V[0] << ", draw " << n);
        const double energy = cell.E[0] + cell.E[1];
        const double size = std::fabs(cell.E[0]) + std::fabs(cell.E[1]);
        const auto result = equilibration.equilibrate({cell.M, cell.V, cell.E});
        ASSERT_EQ(result.failed, -1);
        EXPECT_LE(cell.apart(result.pressure), limit);
        EXPECT_DOUBLE_EQ(cell.V[0] + cell.V[1], 1.0);
        EXPECT_NEAR(cell.E[0] + cell.E[1], energy, 4e-16 * size);
      }
    }
  EXPECT_GE(drawn, min_drawn * draws * pairs);
}

INSTANTIATE_TEST_SUITE_P(Apart, EquilibrationOfLaws, testing::Values(1.1, 10.0, 1e3));

// A volume whose excess of pressure is below what an ulp of it changes is found: the search went on
// from there to no volume at all.
TEST(EquilibrationOfWater, EndsWhereAVolumeIsWithinAnUlp) {
  const Fluid water{eos::ThomsenHartkaWater{}, std::nullopt, 1.4, 1000},
      air{eos::warm_air(), std::nullopt, 1.4, 717.5};
  double M[] = {1031.6361552179419, 0.0030044318945017224},
         V[] = {0.99633358358334778, 0.003666416416652257},
         E[] = {49948241.895967148, 1200.2396081029763};
  const auto result = Equilibration({water, air}).equilibrate({M, V, E});
  ASSERT_EQ(result.failed, -1);
  EXPECT_NEAR(water.pressure(M[0] / V[0], E[0] / V[0]), result.pressure, 1e-6 * result.pressure);
  EXPECT_NEAR(air.pressure(M[1] / V[1], E[1] / V[1]), result.pressure, 1e-6 * result.pressure);
}

// Vapour that a cavity has thinned out for long, beside a liquid that closes it: the pressure
// sought lies up to two hundred decades above its own.
TEST(EquilibrationOfVapour, GoesWhereTheLiquidClosesItsCavity) {
  const eos::StiffenedGas water{4.4, 6e8, 0.0, 4186.0};
  const eos::BirchMurnaghan solid{{7.0, 4.5e-10, 1000.0, 101325.0, 1000.0}};
  const eos::Murnaghan matter{{7.0, 4.5e-10, 1000.0, 101325.0, 1000.0}};
  const Fluid liquid{water, std::nullopt, 4.4, 4186.0};
  constexpr double pressure = 3e7, T = 300.0;  // of the liquid
  const double rho = liquid.density(pressure, T), rho_e = liquid.energy_from_temperature(rho, T);
  for (const eos::EquationOfState& law :
       {eos::EquationOfState(solid), eos::EquationOfState(matter)})
    for (const double cavity : {1e-8, 1e-4, 1e-2})
      for (const double thinned : {1e-20, 1e-60, 1e-130, 1e-190}) {
        SCOPED_TRACE(testing::Message() << "a cavity of " << cavity << ", vapour " << thinned);
        const Fluid vapour{law, std::nullopt, 1.4, 1000};
        const double thin = thinned / cavity;
        double M[] = {rho * (1 - cavity), thinned}, V[] = {1 - cavity, cavity};
        double E[] = {rho_e * (1 - cavity), cavity * vapour.energy_from_temperature(thin, T)};
        const double energy = E[0] + E[1];
        const auto result = Equilibration({liquid, vapour}).equilibrate({M, V, E});
        ASSERT_EQ(result.failed, -1);
        for (int m = 0; m < 2; ++m) {
          const Fluid& fluid = m == 0 ? liquid : vapour;
          EXPECT_NEAR(fluid.pressure(M[m] / V[m], E[m] / V[m]), result.pressure, 1e-6 * pressure);
        }
        EXPECT_DOUBLE_EQ(V[0] + V[1], 1.0);
        EXPECT_NEAR(E[0] + E[1], energy, 4e-16 * energy);
      }
}

}  // namespace
}  // namespace sluice::ice::mixture::equilibrate_laws_test
