// The closed set as a whole: every law has all functions, and any heat can stand beside it.
#include "eos/eos.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "eos/bracketed_root.hpp"
#include "eos/eos_test_support.hpp"

namespace sluice::eos::eos_test {
namespace {

template <std::size_t... I>
consteval bool all_are_laws(std::index_sequence<I...>) {
  return (Law<std::variant_alternative_t<I, EquationOfState>> && ...) &&
         (std::is_trivially_copyable_v<std::variant_alternative_t<I, EquationOfState>> && ...);
}
static_assert(all_are_laws(std::make_index_sequence<std::variant_size_v<EquationOfState>>{}));

TEST(EquationOfState, IsVisitedOutsideALoop) {
  const EquationOfState water = stiff_water;
  double rho[8], E[8], p[8];
  for (int i = 0; i < 8; ++i) rho[i] = 1000.0 + i, E[i] = 1e9 + 1e7 * i;
  std::visit(
      [&](const auto& law) {
        for (int i = 0; i < 8; ++i) p[i] = law.pressure(rho[i], E[i]);
      },
      water);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(p[i], 3.4 * (E[i] + 1.2e6 * rho[i]) - 4.4 * 6e8, 1e-6);
}

// No number, however absurd, hangs a search; what is admissible has a pressure, c and temperature.
TEST(EquationOfState, AnswersToAnyNumber) {
  constexpr double infinity = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const double numbers[] = {0.0,    -0.0,  -1.0, -1e9,  -1e300, -infinity, 1e-305,
                            1e-300, 1e-30, 1.0,  1e3,   2.7e3,  8.9e3,     1e6,
                            3e9,    1e12,  1e30, 1e150, 1e300,  infinity,  nan};
  const std::vector<EquationOfState> laws = one_of_each();
  ASSERT_EQ(laws.size(), std::variant_size_v<EquationOfState>);
  for (const EquationOfState& any : laws)
    std::visit(
        [&](const auto& law) {
          int admissible = 0, answers = 0;
          for (const double rho : numbers)
            for (const double x : numbers) {
              const double asked = law.density(x, rho) + law.bulk_modulus(rho, x) +
                                   law.sound_speed(rho, x) + law.energy_from_temperature(rho, x);
              answers += std::isnan(asked) ? 0 : 1;
              if (!law.admissible(rho, x)) continue;
              ++admissible;
              SCOPED_TRACE(testing::Message() << any.index() << " rho " << rho << " E " << x);
              EXPECT_TRUE(std::isfinite(law.pressure(rho, x)));
              EXPECT_TRUE(std::isfinite(law.temperature(rho, x)));
              EXPECT_GT(law.temperature(rho, x), 0.0);
              EXPECT_GT(law.sound_speed_squared(rho, x), 0.0);
            }
          EXPECT_GT(admissible, 0) << any.index();
          EXPECT_GT(answers, 0) << any.index();
        },
        any);
}

// cp/cv of a state: that of a gas, next to 1 for liquids and solids; where the specific heat varies
// 1 + R/cv.
TEST(EquationOfState, HasTheRatioOfSpecificHeatsOfItsState) {
  const auto ratio = [](const auto& law, double rho, double T, double cv) {
    return law.heat_capacity_ratio(rho, law.energy_from_temperature(rho, T), T, cv);
  };
  EXPECT_EQ(ratio(air, 1.2, 300.0, 717.5), 1.4);
  EXPECT_EQ(ratio(stiff_water, 1e3, 300.0, 1816.0), 4.4);
  EXPECT_EQ(ratio(hard_spheres, 100.0, 300.0, 1100.0), 1.3);
  EXPECT_EQ(ratio(steep_solid, 1200.0, 300.0, 1400.0), 1.0);
  const auto hot = warm_air();
  for (const double T : {300.0, 1500.0})
    EXPECT_DOUBLE_EQ(ratio(hot, 0.5, T, hot.heat.specific_heat(T)),
                     1.0 + 287.0 / hot.heat.specific_heat(T));
  EXPECT_NEAR(ratio(hot, 0.5, 1500.0, hot.heat.specific_heat(1500.0)), 1.310, 1e-3);
  const TstGas ideal{{.a = 0.0, .b = 1e-12, .Gamma = 1.4, .specific_heat = 717.5}};
  EXPECT_NEAR(ratio(ideal, 1.2, 300.0, 717.5), 1.4, 1e-9);
  EXPECT_NEAR(ratio(attracting_gas, 50.0, 600.0, 1500.0), 1.42715, 1e-5);
  EXPECT_NEAR(ratio(copper, 8930.0, 294.0, 385.0),  // c = C0 there
              1.0 / (1.0 - 2.02 * 2.02 * 385.0 * 294.0 / (3940.0 * 3940.0)), 1e-12);
}

// Names and numbers are those of a deck: none twice, each with a meaning.
TEST(EquationOfState, DescribesItself) {
  std::set<std::string_view> names;
  AllLaws::for_each([&]<class T>() {
    if constexpr (is_named_by_decks<T>()) {
      EXPECT_TRUE(names.insert(T::name).second) << T::name;
      std::set<std::string_view> numbers;
      for (const auto& number : T::parameters()) {
        EXPECT_TRUE(numbers.insert(number.name).second) << T::name << ' ' << number.name;
        EXPECT_FALSE(number.meaning.empty()) << T::name << ' ' << number.name;
      }
      EXPECT_EQ(name_of(example<T>()), T::name);
    }
  });
}

// Density at a pressure and temperature: found, or said to be missing, and never another state.
TEST(EquationOfState, FindsDensitiesOverDecadesOfPressure) {
  for (const EquationOfState& any : one_of_each())
    std::visit(
        [&](const auto& law) {
          int found = 0;
          for (double p = 1e-3; p < 1e13; p *= 3.7)
            for (const double T : {280.0, 300.0, 3000.0}) {
              const double rho = law.density(p, T);
              if (std::isnan(rho)) continue;
              const double E = law.energy_from_temperature(rho, T);
              if (!law.admissible(rho, E)) continue;
              ++found;
              const double K = rho * law.sound_speed_squared(rho, E);
              EXPECT_NEAR(law.pressure(rho, E), p, 1e-9 * p + 1e-11 * K) << any.index() << ' ' << T;
            }
          EXPECT_GE(found, 20) << any.index();
        },
        any);
}

TEST(EquationOfState, TakesASpecificHeatThatIsNotConstant) {
  const Nasa7Heat heat = component_heat({.CO2 = 0.3, .H2O = 0.3, .N2 = 0.4});
  for (const double rho : {0.1, 100.0, 2000.0})
    for (const double T : {300.0, 2500.0, 8000.0}) {
      const double E = energy_from_temperature(tnt, heat, rho, T);
      EXPECT_NEAR(temperature(tnt, heat, rho, E), T, 1e-8 * T);
      EXPECT_NEAR(density(tnt, heat, tnt.pressure(rho, E), T), rho, 1e-10 * rho);
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
}  // namespace sluice::eos::eos_test
