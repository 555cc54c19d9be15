// Tillotson: every check of a law in each of its regions, and shocked aluminium.
#include "eos/tillotson.hpp"

#include "eos/eos_test_support.hpp"

namespace sluice::eos::tillotson_test {
namespace {

TEST(Tillotson, IsConsistentInCompression) {
  check_law(aluminium, {2700.0, 8e3, 100.0, 1e5, 2700.0}, {.slopes = 1e-8}, false);
  check_extremes(aluminium, 2700.0, 1e7);
}

TEST(Tillotson, IsConsistentInExpansion) {  // cold, partly vaporised, vapour
  check_law(aluminium, {2400.0, 2700.0, 100.0, 3200.0, 2700.0}, {.slopes = 1e-8}, false);
  check_law(aluminium, {1200.0, 2700.0, 3400.0, 1.5e4, 2700.0, 1e-4, 0.5}, {.slopes = 1e-7}, false);
  check_law(aluminium, {1e-3, 2600.0, 1.6e4, 1e6}, {.slopes = 2e-7}, false);
}

TEST(Tillotson, IsContinuousWhereItsRegionsMeet) {
  const auto p = [](double rho, double e) { return aluminium.pressure(rho, rho * e); };
  for (const double rho : {1.0, 300.0, 1500.0, 2650.0})
    for (const double e : {3e6, 13.9e6})
      EXPECT_NEAR(p(rho, e * (1 - 1e-12)), p(rho, e * (1 + 1e-12)),
                  1.0 + 1e-12 * std::abs(p(rho, e)));
  for (const double e : {1e5, 5e6, 2e7})
    EXPECT_NEAR(p(2700 * (1 - 1e-12), e), p(2700 * (1 + 1e-12), e), 1.0);
}

// Aluminium 1100: Us = 5.386 + 1.339 up in km/s (Kinslow, High-Velocity Impact Phenomena, 1970).
TEST(Tillotson, MeetsTheHugoniotOfAluminium) {
  for (const double up : {0.5e3, 1e3, 2e3, 4e3}) {
    const auto excess = [&](double rho) {  // pressure over what momentum asks for, energy up^2/2
      const double E = 0.5 * rho * up * up, flow = up * rho / (rho - 2700.0);
      return ValueAndSlope{aluminium.pressure(rho, E) - 2700.0 * flow * up, 0.0};
    };
    const double rho = bracketed_root(excess, 2701.0, 6000.0, 3000.0);
    const double Us = 5386.0 + 1.339 * up;
    EXPECT_NEAR(up * rho / (rho - 2700.0), Us, 0.02 * Us) << up;
  }
}

TEST(Tillotson, LeavesOutTheUnstableExpansion) {
  const auto ok = [](double rho, double e) { return aluminium.admissible(rho, rho * e); };
  EXPECT_TRUE(ok(2600.0, 3e5));
  EXPECT_FALSE(ok(800.0, 1e5));
  EXPECT_FALSE(ok(2700.0, -1.0));
  EXPECT_TRUE(ok(1e-6, 5e7));
}

}  // namespace
}  // namespace sluice::eos::tillotson_test
