// Semi-implicit steps of water under air: the foot of a falling column against an experiment, the
// period of a tank that sloshes against linear theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/archive/archive.hpp"
#include "verification/case_run.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::implicit_surfaces_test {
namespace {

// J. C. Martin and W. J. Moyce, Phil. Trans. R. Soc. A 244 (1952) 312-324, figure 3: columns 2.25
// inches wide and twice as high. T = t sqrt(2 g/a), Z = x/a of the foot.
struct Seen {
  double T, Z;
};
constexpr Seen martin_moyce[] = {{0.832, 1.217}, {1.219, 1.474}, {1.997, 2.292}, {2.547, 2.995}};
constexpr double width = 0.05715, gravity = 9.81;
// Nothing is unbounded: air that water pushes away is no swifter than some times the fall through
// twice the width, and no pressure is above that of water which stops from that fall at once.
constexpr double fall = 1.5;                        // m/s, sqrt(2 g 2 a)
constexpr double swiftest = 10 * fall;              // m/s
constexpr double water_hammer = 1e3 * 1625 * fall;  // Pa, rho c u

// Where the share of water in the lowest row falls through a half, last.
double foot_of(const CellValues& water) {
  for (int i = water.size.x - 1; i > 0; --i) {
    const double here = water.at(i - 1), beyond = water.at(i);
    if (here >= 0.5 && beyond < 0.5)
      return water.centre(i - 1).x + (here - 0.5) / (here - beyond) * water.spacing.x;
  }
  return 0;
}

// The largest relative distance from the experiment, between outputs by their line.
double distance_from_experiment(int cells_a_height) {
  const CaseRun run("implicit_dam", until(0.14) + Overrides{"DataArchiver/outputInterval=0.002",
                                                            resolution(5 * cells_a_height / 2,
                                                                       5 * cells_a_height / 4)});
  const auto outputs = static_cast<int>(Archive::open(run.archive()).outputs().size());
  double worst = 0, largest_u = 0, largest_p = 0, T_before = 0, Z_before = 1;
  for (int o = 1; o < outputs; ++o) {
    const std::string which = "#" + std::to_string(o);
    const CellValues water = run.field("vol_frac_CC", 0, which);
    const double T = water.time * std::sqrt(2 * gravity / width), Z = foot_of(water) / width;
    for (const Seen& seen : martin_moyce) {
      if (seen.T <= T_before || seen.T > T) continue;
      const double here = Z_before + (Z - Z_before) * (seen.T - T_before) / (T - T_before);
      record(fmt::format("Z at {}", seen.T), here);
      worst = std::max(worst, std::fabs(here / seen.Z - 1));
    }
    for (int c = 0; c < 2; ++c)
      largest_u = std::max(largest_u, farthest_from(run.field("vel_CC", c, which), 0));
    largest_p = std::max(largest_p, farthest_from(run.field("press_CC", 0, which), 1e5));
    T_before = T;
    Z_before = Z;
  }
  EXPECT_GT(T_before, martin_moyce[3].T);
  record("largest velocity", largest_u);
  record("largest pressure", largest_p);
  EXPECT_LE(largest_u, swiftest);
  EXPECT_LE(largest_p, water_hammer);
  return worst;
}

// Not met: Z 1.39 instead of 1.217 at T .832, then spray ahead of the foot, in steps of 1e-5 s.
TEST(FullImplicitDam, DISABLED_FootRunsOutAsMeasured) {
  EXPECT_LE(distance_from_experiment(64), 0.05);
}

// Height of the surface at the left wall over that at the right one.
double tilt(const CellValues& water) {
  double left = 0, right = 0;
  for (int j = 0; j < water.size.y; ++j) {
    left += water.at(0, j);
    right += water.at(water.size.x - 1, j);
  }
  return (left - right) * water.spacing.y;
}

// H. Lamb, Hydrodynamics (1932), section 228.
double period_of_theory() {
  constexpr double k = std::numbers::pi, depth = 0.5;
  return 2 * std::numbers::pi / std::sqrt(gravity * k * std::tanh(k * depth));
}

// Twice the time at which the surface that began to rise is flat again, by the line through two
// outputs, over that of the theory.
double half_period(int n) {
  const CaseRun run("implicit_sloshing", Overrides{resolution(n, n), "Time/maxTime=0.7",
                                                   "DataArchiver/outputInterval=0.01",
                                                   "Time/clamp_time_to_output=true"});
  const std::size_t outputs = Archive::open(run.archive()).outputs().size();
  double before = 0, time_before = 0;
  for (std::size_t o = 1; o < outputs; ++o) {
    const CellValues water = run.field("vol_frac_CC", 0, "#" + std::to_string(o));
    const double now = tilt(water);
    if (water.time > 0.2 && before > 0 && now <= 0) {
      const double crossing = time_before + before / (before - now) * (water.time - time_before);
      return 2 * crossing / period_of_theory();
    }
    before = now;
    time_before = water.time;
  }
  ADD_FAILURE() << "the surface never comes back";
  return 0;
}

TEST(FullImplicitSloshing, HasThePeriodOfTheory) {
  const double ratio = half_period(64);
  record("period", ratio);
  EXPECT_NEAR(ratio, 1, 0.02);
}

}  // namespace
}  // namespace sluice::verification::implicit_surfaces_test
