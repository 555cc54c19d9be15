// The rates of a state are those that a step leaves which changes nothing.
#include <gtest/gtest.h>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::rates_test {
namespace {

// A uniform state stays what it is, so that its first step may be as long as its next: with slip,
// sound is that of materials that pressure alone binds.
TEST(RatesOfAState, TheFirstStepMayBeAsLongAsTheNext) {
  constexpr double round_off = 1e-12;
  const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
  const Fluid water = stiffened_gas(4.4, 6e8);
  GasBox box;
  box.scheme = "conservative";
  for (const int ny : {1, 8}) {
    box.cells = {8, ny, 1};
    for (const std::vector<double>& V :
         {std::vector<double>{.7, .3}, {.05, .95}, {.3, .5, .2}, {1, 0}, {0, .6, .4}})
      for (const double slip : {0., 300.}) {
        std::vector<Fluid> fluids = {water, air};
        if (V.size() == 3) fluids.push_back(heavy);
        MixtureBox run(
            box, fluids,
            [&](Vec3) {
              MixtureCell c;
              c.volume = V;
              c.density = {1000, 1, 3};
              c.pressure = {1e5, 1e5, 1e5};
              c.velocity[0] = 20;
              c.slip = {0, slip, -slip};
              return c;
            },
            {}, {}, {}, 0.0);
        const StepLimit first = run.limit();
        run.step(1e-3 * first.dt);
        EXPECT_NEAR(run.limit().dt, first.dt, round_off * first.dt) << V[0] << " " << slip;
        EXPECT_EQ(run.limit().reason, first.reason);
      }
  }
}

}  // namespace
}  // namespace sluice::ice::rates_test
