// Ignition of hydrogen and air in a closed cell: the delay against small steps of Runge and Kutta
// and against tight tolerances, the end against the equilibrium.
#include <gtest/gtest.h>

#include "kinetics/gas_test_support.hpp"
#include "kinetics/rates.hpp"
#include "kinetics/reactor.hpp"

namespace sluice::kinetics::ignition_test {
namespace {

using namespace testing_gas;

constexpr double start_temperature = 1000, rise = 400;  // K: ignited

// Mass fractions of all species; T from the energy. The rates of the same class, nothing else.
class SmallSteps {
 public:
  SmallSteps() : rates_(hydrogen()), Y_(hydrogen_air()) {
    rho_ = density(hydrogen(), Y_, 101325, start_temperature);
    whole_ = energy(hydrogen(), Y_, start_temperature) + formation(Y_);
  }
  double temperature() const {
    return testing_gas::temperature(hydrogen(), Y_, whole_ - formation(Y_));
  }
  const std::vector<double>& fractions() const { return Y_; }

  void step(double dt) {
    const std::vector<double> a = slope(Y_), b = slope(moved(a, dt / 2)),
                              c = slope(moved(b, dt / 2)), d = slope(moved(c, dt));
    for (std::size_t k = 0; k < 8; ++k) Y_[k] += dt / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }

 private:
  static double formation(const std::vector<double>& Y) {
    double sum = hydrogen().formation_energy(N2);
    for (std::size_t k = 0; k < 8; ++k)
      sum += Y[k] * (hydrogen().formation_energy(k) - hydrogen().formation_energy(N2));
    return sum;
  }
  std::vector<double> moved(const std::vector<double>& slope, double dt) const {
    std::vector<double> Y = Y_;
    for (std::size_t k = 0; k < 8; ++k) Y[k] += dt * slope[k];
    return Y;
  }
  std::vector<double> slope(const std::vector<double>& Y) {
    std::vector<double> omega(9);
    rates_.at(testing_gas::temperature(hydrogen(), Y, whole_ - formation(Y)));
    rates_.production(concentrations(hydrogen(), rho_, Y).data(), omega.data());
    for (std::size_t k = 0; k < 8; ++k) omega[k] *= burke_hydrogen().species[k].molar_mass / rho_;
    return omega;
  }

  Rates rates_;
  std::vector<double> Y_;
  double rho_ = 0, whole_ = 0;
};

// When T has risen by `rise`, s; straight between the ends of steps dt.
template <class Advance>
double delay(double dt, Advance&& temperature_after) {
  double earlier = start_temperature;
  for (int n = 1; n < 100'000; ++n) {
    const double T = temperature_after();
    const double aim = start_temperature + rise;
    if (T >= aim) return dt * (n - 1 + (aim - earlier) / (T - earlier));
    earlier = T;
  }
  return 0;
}

double delay_of_reactor(Tolerances tolerances, double dt) {
  Reactor reactor(hydrogen(), tolerances);
  std::vector<double> Y = hydrogen_air();
  const double rho = density(hydrogen(), Y, 101325, start_temperature);
  double e = energy(hydrogen(), Y, start_temperature);
  return delay(dt, [&] {
    e += reactor.advance(rho, e, Y.data(), dt).heat / rho;
    return temperature(hydrogen(), Y, e);
  });
}

TEST(Ignition, DelayIsThatOfOtherIntegrations) {
  const double ours = delay_of_reactor({}, 2e-6);
  SmallSteps small;
  constexpr int within = 50;
  const double reference = delay(2e-6, [&] {
    for (int n = 0; n < within; ++n) small.step(2e-6 / within);
    return small.temperature();
  });
  const double tight = delay_of_reactor({1e-12, 1e-9, 1e-16}, 2e-6);
  EXPECT_NEAR(tight / reference, 1, 1e-5);
  EXPECT_NEAR(ours / reference, 1, 2e-4);
  EXPECT_GT(ours, 1e-4);
  EXPECT_LT(ours, 4e-4);
}

TEST(Ignition, RadicalsGrowAsInSmallSteps) {
  Reactor reactor(hydrogen(), {1e-10, 1e-8, 1e-18});
  std::vector<double> Y = hydrogen_air();
  const double rho = density(hydrogen(), Y, 101325, start_temperature);
  reactor.advance(rho, energy(hydrogen(), Y, start_temperature), Y.data(), 4e-5);
  SmallSteps small;
  for (int n = 0; n < 1000; ++n) small.step(4e-8);
  for (const Place k : {H, O, OH, HO2, H2O})
    EXPECT_NEAR(Y[k], small.fractions()[k], 1e-5 * small.fractions()[k] + 1e-12) << k;
}

TEST(Ignition, EndsAtTheEquilibrium) {
  std::vector<double> Y = hydrogen_air();
  const double rho = density(hydrogen(), Y, 101325, start_temperature);
  double e = energy(hydrogen(), Y, start_temperature);
  const auto [T, c] = burnt(concentrations(hydrogen(), rho, Y), start_temperature);
  Reactor reactor(hydrogen(), {});
  e += reactor.advance(rho, e, Y.data(), 0.1).heat / rho;
  EXPECT_NEAR(temperature(hydrogen(), Y, e) / T, 1, 1e-6);
  const std::vector<double> end = concentrations(hydrogen(), rho, Y);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(end[k], c[k], 1e-5 * c[k] + 1e-9) << k;
}

}  // namespace
}  // namespace sluice::kinetics::ignition_test
