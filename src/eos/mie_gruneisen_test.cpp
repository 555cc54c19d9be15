// Mie-Grueneisen: every check of a law, and copper.
#include "eos/mie_gruneisen.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::mie_gruneisen_test {
namespace {

TEST(MieGruneisen, IsConsistent) {
  check_law(copper, {8930.0, 2e4, 100.0, 1e4, 8930.0}, {.slopes = 1e-8, .mixed = 2e-8});
  check_law(copper, {5e3, 8930.0, 100.0, 1e4, 8930.0}, {.slopes = 1e-8, .mixed = 2e-8});
  check_extremes(copper, 8930.0, 1e6);
  const MieGruneisen plain{{.C0 = 1500.0, .rho0 = 1e3, .specific_heat = 4000.0}};  // S = Gamma0 = 0
  EXPECT_NEAR(plain.pressure(1100.0, 0.0), 1e3 * 1500.0 * 1500.0 / 11.0, 1e-4);
  EXPECT_NEAR(plain.temperature(1e3, 0.0), 300.0, 1e-9);
}

TEST(MieGruneisen, MeetsTheHugoniotOfCopper) {
  const auto compressed = [](double chi) { return 8930.0 / (1.0 - chi); };
  EXPECT_NEAR(copper.pressure(compressed(0.02), 0.0), 2.885831e9, 1e3);
  EXPECT_NEAR(copper.pressure(compressed(0.1), 0.0), 1.7204514e10, 1e4);
  EXPECT_NEAR(copper.pressure(compressed(-0.02), 0.0), -2.772515e9, 1e3);
  const double rho = compressed(0.1), up = 462.930, Us = 4629.303;
  EXPECT_NEAR(copper.pressure(rho, rho * 0.5 * up * up), 1.9137391e10, 1e5);
  EXPECT_NEAR(8930.0 * Us * up, 1.9137391e10, 1e5);
}

// Along an isentrope (de = p/rho^2 drho by small steps) T = T0 exp(Gamma0 chi).
TEST(MieGruneisen, KeepsTheTemperatureOfItsIsentrope) {
  for (const double end : {0.5, -0.5}) {  // chi S = 0.74 in compression
    double e = 0.0;
    const int steps = 4000;
    const double h = end / steps;
    const auto de = [&](double chi, double energy) {  // per chi: d rho / rho^2 = d chi / rho0
      const double rho = 8930.0 / (1.0 - chi);
      return copper.pressure(rho, rho * energy) / 8930.0;
    };
    for (int i = 0; i < steps; ++i) {
      const double chi = i * h, k1 = de(chi, e), k2 = de(chi + h / 2, e + h / 2 * k1);
      const double k3 = de(chi + h / 2, e + h / 2 * k2), k4 = de(chi + h, e + h * k3);
      e += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const double rho = 8930.0 / (1.0 - end), T = 294.0 * std::exp(2.02 * end);
    EXPECT_NEAR(copper.temperature(rho, rho * e), T, 1e-7 * T) << end;
  }
}

}  // namespace
}  // namespace sluice::eos::mie_gruneisen_test
