// Fragments of a material stay together: how far from the path of their edges they are found.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "ice/mixture/mixture_test_support.hpp"

namespace sluice::ice {
namespace {

constexpr int cells = 100;
const Fluid air = ideal_gas(1.4, 717), water = stiffened_gas(4.4, 6e8);

// Velocity at x, linear between centres of a periodic box of unit length.
double velocity_at(const MixtureBox& run, double x) {
  const double s = x * cells - .5;
  const double low = std::floor(s);
  const auto cell = [](double i) {
    const int k = static_cast<int>(i) % cells;
    return IntVec3{k < 0 ? k + cells : k, 0, 0};
  };
  const double w = s - low;
  return (1 - w) * run.velocity(cell(low)) + w * run.velocity(cell(low + 1));
}

struct Fragment {
  double left = .4, right = .6;  // edges that move with the flow
  // Largest distance in cells, outside the edges, of a cell with the material.
  double reach(const MixtureBox& run, int m) const {
    double worst = 0;
    for (int i = 0; i < cells; ++i) {
      if (run.mass(m, {i, 0, 0}) == 0) continue;
      double off = 1e9;
      for (int image = -3; image <= 3; ++image) {
        const double x = (i + .5) / cells + image;
        off = std::fmin(off, std::fmax(0.0, std::fmax(left - x, x - right)));
      }
      worst = std::fmax(worst, off * cells);
    }
    return worst;
  }
};

MixtureBox swept_fragments(double p, double trace, bool water_in_air) {
  GasBox box;
  box.cells = {cells, 1, 1};
  box.scheme = "conservative";
  return {
      box, {water, air}, [=](Vec3 x) {
        MixtureCell c;
        const double little = x.x > .4 && x.x < .6 ? trace : 0.0;
        c.volume = water_in_air ? std::vector{little, 1 - little} : std::vector{1 - little, little};
        c.density = {1000, 1.2};
        const double here = x.x < .2 ? p : 1e5;
        c.pressure = {here, here};
        return c;
      }};
}

// Where there is some of the material.
double lowest_pressure(const MixtureBox& run, int m) {
  double p = 1e99;
  for (int i = 0; i < cells; ++i)
    if (run.mass(m, {i, 0, 0}) != 0) p = std::fmin(p, run.pressure({i, 0, 0}));
  return p;
}

class CompactSupport : public testing::TestWithParam<std::tuple<double, double, bool>> {};

// Where water is torn apart the air becomes the cavity, several cells wide: then there is no front
// to be near to. Nor is there one where fragments are cells five apart, as in the random starts of
// TracesSurviveWaves: nothing can be farther than that.
TEST_P(CompactSupport, FragmentsStayTogether) {
  constexpr double farthest = 6, cavity = 100;  // cells, Pa
  const auto [p, trace, water_in_air] = GetParam();
  const int m = water_in_air ? 0 : 1;
  MixtureBox run = swept_fragments(p, trace, water_in_air);
  Fragment fragment;
  double worst = 0;
  int steps = 0;
  for (; steps < 1500 && lowest_pressure(run, m) > cavity; ++steps) {
    const double l = velocity_at(run, fragment.left), r = velocity_at(run, fragment.right);
    const double start = run.time();
    run.steps(1);
    const double dt = run.time() - start;  // Heun's rule
    fragment.left += .5 * dt * (l + velocity_at(run, fragment.left + dt * l));
    fragment.right += .5 * dt * (r + velocity_at(run, fragment.right + dt * r));
    worst = std::fmax(worst, fragment.reach(run, m));
  }
  RecordProperty("cells", std::to_string(worst));
  RecordProperty("steps", steps);
  EXPECT_LE(worst, farthest);
  EXPECT_GE(steps, 300);
}

INSTANTIATE_TEST_SUITE_P(Of, CompactSupport,
                         testing::Combine(testing::Values(1e7, 1e9),
                                          testing::Values(1e-4, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15,
                                                          1e-30),
                                          testing::Bool()));

// Oblique flow: cells have two outlets, and what leaves through both leaves a share of a share.
TEST(CompactSupport, NothingStaysBehindInObliqueFlow) {
  constexpr double least = 1e-20;  // of a cell; through both outlets it fell to 1e-309
  GasBox box;
  box.cells = {40, 40, 1};
  box.scheme = "conservative";
  MixtureBox run(box, {water, air}, [](Vec3 x) {
    const double r2 = (x.x - .5) * (x.x - .5) + (x.y - .5) * (x.y - .5);
    MixtureCell c;
    c.volume = {r2 < .04 ? 1.0 : 0.0, r2 < .04 ? 0.0 : 1.0};
    c.density = {1000, 1.2};
    c.pressure = {1e5, 1e5};
    c.velocity[0] = 100;
    c.velocity[1] = 60;
    return c;
  });
  const auto cells_of = [&](int m) {
    int count = 0;
    for_each_cell(run.domain(), [&](IntVec3 c) {
      if (run.mass(m, c) == 0) return;
      ++count;
      EXPECT_GE(run.volume(m, c), least);
    });
    return count;
  };
  const int before = cells_of(0);
  run.steps(1500);
  const int after = cells_of(0);
  RecordProperty("before", before);
  RecordProperty("after", after);
  // A rim of five cells around the disc, 8 cells in radius.
  EXPECT_LE(after, 3.1416 * (8 + 5) * (8 + 5));
  EXPECT_EQ(run.rejected(), 0);
}

}  // namespace
}  // namespace sluice::ice
