// The closed set as a whole: every law has all functions, and any heat can stand beside it.
#include "eos/eos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "eos/bracketed_root.hpp"
#include "eos/component_heat.hpp"

namespace sluice::eos {
namespace {

template <std::size_t... I>
consteval bool all_are_laws(std::index_sequence<I...>) {
  return (Law<std::variant_alternative_t<I, EquationOfState>> && ...) &&
         (std::is_trivially_copyable_v<std::variant_alternative_t<I, EquationOfState>> && ...);
}
static_assert(all_are_laws(std::make_index_sequence<std::variant_size_v<EquationOfState>>{}));

TEST(EquationOfState, IsVisitedOutsideALoop) {
  const EquationOfState water = StiffenedGas{{.gamma = 4.4, .pinf = 6e8, .specific_heat = 1816.0}};
  double rho[8], E[8], p[8];
  for (int i = 0; i < 8; ++i) rho[i] = 1000.0 + i, E[i] = 1e9 + 1e7 * i;
  std::visit(
      [&](const auto& law) {
        for (int i = 0; i < 8; ++i) p[i] = law.pressure(rho[i], E[i]);
      },
      water);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(p[i], 3.4 * E[i] - 4.4 * 6e8, 1e-6);
}

TEST(EquationOfState, TakesASpecificHeatThatIsNotConstant) {
  const Jwl products{{.A = 371.2e9,
                      .B = 3.231e9,
                      .R1 = 4.15,
                      .R2 = 0.95,
                      .om = 0.30,
                      .rho0 = 1630.0,
                      .specific_heat = 1000.0}};
  const Nasa7Heat heat = component_heat({.CO2 = 0.3, .H2O = 0.3, .N2 = 0.4});
  for (const double rho : {0.1, 100.0, 2000.0})
    for (const double T : {300.0, 2500.0, 8000.0}) {
      const double E = energy_from_temperature(products, heat, rho, T);
      EXPECT_NEAR(temperature(products, heat, rho, E), T, 1e-8 * T);
      EXPECT_NEAR(density(products, heat, products.pressure(rho, E), T), rho, 1e-10 * rho);
    }
}

TEST(BracketedRoot, FindsRootsThatNewtonAloneMisses) {
  const auto atan = [](double x) { return ValueAndSlope{std::atan(x), 1.0 / (1.0 + x * x)}; };
  EXPECT_NEAR(bracketed_root(atan, -50.0, 1e3, 20.0), 0.0, 1e-300);
  const auto steep = [](double x) {
    return ValueAndSlope{std::pow(x, 99) - 1e-9, 99 * std::pow(x, 98)};
  };
  EXPECT_NEAR(bracketed_root(steep, 0.0, 1e6, 1e6), std::pow(1e-9, 1.0 / 99), 1e-14);
  const auto jump = [](double x) { return ValueAndSlope{x < 0.3 ? -1.0 : 2.0, 0.0}; };
  EXPECT_NEAR(bracketed_root(jump, 0.0, 1.0, 0.9), 0.3, 1e-14);
  const auto decades = [](double x) { return ValueAndSlope{std::log(x / 1e-20), 1.0 / x}; };
  EXPECT_NEAR(bracketed_root(decades, 1e-30, 1e30, 1.0), 1e-20, 1e-33);
}

}  // namespace
}  // namespace sluice::eos
