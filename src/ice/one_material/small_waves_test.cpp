// Small waves in gas at rest, in all directions at once, at the longest step that is allowed.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::small_waves_test {
namespace {

class SmallWaves : public testing::TestWithParam<IntVec3> {};

TEST_P(SmallWaves, DoNotGrow) {
  constexpr double height = 1e-6;
  GasBox box;
  box.cells = GetParam();
  box.scheme = "conservative";
  box.cfl = .9;
  // Pressures of all lengths of waves the grid knows, without a pattern.
  MixtureBox run(box, {ideal_gas(1.4, 1)}, [](Vec3 x) {
    const double noise = 1e4 * std::sin(12.9898 * x.x + 78.233 * x.y + 37.719 * x.z + 1);
    MixtureCell c;
    c.volume = {1};
    c.density = {1};
    c.pressure = {1 + height * (2 * (noise - std::floor(noise)) - 1)};
    return c;
  });
  run.steps(300);
  double largest = 0;
  for_each_cell(run.domain(),
                [&](IntVec3 c) { largest = std::fmax(largest, std::fabs(run.pressure(c) - 1)); });
  EXPECT_LT(largest, height);
}

INSTANTIATE_TEST_SUITE_P(InDirections, SmallWaves,
                         testing::Values(IntVec3{48, 1, 1}, IntVec3{24, 24, 1},
                                         IntVec3{12, 12, 12}));

}  // namespace
}  // namespace sluice::ice::small_waves_test
