// The classic form against numbers that Uintah itself computed, with Uintah's steps.
//
// Uintah's step follows from the sound speed at the start of the step before and the new velocity,
// and it is bounded by flat directions too. Its cells hold 1e-12 more mass than the deck says
// (tiny_rho), which is what remains between the two results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ice/test_support/classic.hpp"

namespace sluice::ice::classic_original_test {
namespace {

constexpr double allowed = 1e-10;  // of the largest values; measured 1e-12

// Largest value of f(cell).
template <class F>
double largest(const Stepper& run, F f) {
  double most = 0;
  for_each_cell(run.domain(), [&](IntVec3 c) { most = std::max(most, f(c)); });
  return most;
}

double sound(const Stepper& run, IntVec3 c) {
  return run.gas.sound_speed(run.mass(c), run.pressure(c));
}

// The deck shockTube: air at 300 K, pressure ratio 10, 250 cells of 4 mm x 1 mm x 1 mm, CFL 0.25.
TEST(ClassicForm, GivesUintahsOwnShockTube) {
  struct Cell {
    int i;
    double density, velocity, temperature;
  };
  constexpr Cell uintah[] = {
      {70, 1.176624211621826, 0.06074906963604917, 299.97908969173665},
      {90, 0.9912313917668267, 58.534783091252244, 280.12552240924623},
      {110, 0.6650632012326099, 187.05786085515186, 238.89273968847013},
      {130, 0.46460252857058865, 294.33758319178094, 206.9789940841369},
      {150, 0.47733248861949645, 286.1378779426801, 209.5979289496871},
      {160, 0.3701892107987496, 285.32976384570463, 270.2313231068706},
      {165, 0.24210381390871105, 286.0926910537862, 413.42703447388544},
      {175, 0.24437769954068272, 286.08592637678197, 409.3845540781624},
      {190, 0.245604836214153, 287.27919174984345, 409.7037761175651},
      {200, 0.11768359175270726, 0.0020309120636380885, 300.0006780144091},
  };
  constexpr double end = 5e-4, heat = 717.5;
  GasBox box;
  box.cells = {250, 1, 1};
  box.high = {1, 0.001, 0.001};
  box.periodic = false;
  box.density = "x < 0.5 ? 1.1768292682926831 : 0.11768292682926831";
  box.pressure = "x < 0.5 ? 101325 : 10132.5";
  box.specific_heat = heat;
  Stepper tube(box);
  auto fastest = [&] { return largest(tube, [&](IntVec3 c) { return sound(tube, c); }); };
  double before = fastest();
  int steps = 0;
  for (; tube.time() < end; ++steps) {
    const double now = fastest();
    tube.step(std::min(0.25 * 0.001 / before, end - tube.time()));
    before = now;
  }
  EXPECT_EQ(steps, 820);
  for (const Cell& u : uintah) {
    const IntVec3 c{u.i, 0, 0};
    EXPECT_NEAR(tube.mass(c), u.density, allowed * 1.2) << u.i;
    EXPECT_NEAR(tube.velocity(c), u.velocity, allowed * 400) << u.i;
    EXPECT_NEAR(tube.energy(c) / (tube.mass(c) * heat), u.temperature, allowed * 400) << u.i;
  }
}

// The deck explosion on 128 x 128 cells, CFL 0.2, at t = 0.25; cells (i, 64).
TEST(ClassicForm, GivesUintahsOwnExplosion) {
  struct Cell {
    double x, density, velocity_x, velocity_y, temperature;
  };
  constexpr Cell uintah[] = {
      {0.0078125, 0.9913031684928687, 0.0020214335540113433, 0.0020214335540114804,
       2.4912871103292895},
      {0.1640625, 0.7757384753623895, 0.24829138404593293, 0.012228144442545144,
       2.2608065017539554},
      {0.3984375, 0.3319910508996015, 0.9685855290038609, 0.019114861232379356, 1.6191116707907365},
      {0.4453125, 0.29358091884067494, 1.0566525376472342, 0.018781056127491414,
       1.5383878684186436},
      {0.5546875, 0.3369567487541216, 0.8783554511948728, 0.011632868039115337, 1.6151569821775318},
      {0.6640625, 0.22630661818084052, 0.7891809728749161, 0.012960443604289208, 2.582431167659097},
      {0.7421875, 0.2245594793045706, 0.7179517322990608, 0.0054111780228174745, 2.558974554885391},
      {0.7890625, 0.24192775594106597, 0.7785756539469174, 0.007921447121624228,
       2.6373776189508717},
      {0.8515625, 0.12574275982091415, 0.006625805490852632, 3.656020777600116e-05,
       2.0047510594872886},
      {0.9140625, 0.12500166176582198, 1.4923283315259614e-05, 8.34164623657803e-08,
       2.0000106352881817},
  };
  constexpr double end = 0.25, dx = 1.0 / 64, cfl = 0.2;
  GasBox box;
  box.cells = {128, 128, 1};
  box.low = {-1, -1, -0.05};
  box.high = {1, 1, 0.05};
  box.periodic = false;
  box.walls = true;
  // A cell is inside when one of its 2 x 2 x 2 sample points is.
  const std::string inside =
      "(abs(x) - 0.00390625)^2 + (abs(y) - 0.00390625)^2 + 0.025^2 < 0.16 ? ";
  box.density = inside + "1 : 0.125";
  box.pressure = inside + "1 : 0.1";
  Stepper run(box);
  std::vector<double> before(128 * 128);
  auto keep_sound = [&] {
    for_each_cell(run.domain(), [&](IntVec3 c) { before[c.x + 128 * c.y] = sound(run, c); });
  };
  keep_sound();
  double last = 1e-5 / 3;
  while (run.time() < end) {
    const double fastest = largest(run, [&](IntVec3 c) {
      return before[c.x + 128 * c.y] +
             std::max(std::fabs(run.velocity(c, 0)), std::fabs(run.velocity(c, 1)));
    });
    keep_sound();
    last = std::min({cfl * dx / fastest, 3 * last, end - run.time()});
    run.step(last);
  }
  for (const Cell& u : uintah) {
    const IntVec3 c{static_cast<int>(std::floor((u.x + 1) / dx)), 64, 0};
    EXPECT_NEAR(run.mass(c), u.density, allowed) << u.x;
    EXPECT_NEAR(run.velocity(c, 0), u.velocity_x, allowed) << u.x;
    EXPECT_NEAR(run.velocity(c, 1), u.velocity_y, allowed) << u.x;
    EXPECT_NEAR(run.energy(c) / run.mass(c), u.temperature, allowed * 3) << u.x;
  }
}

}  // namespace
}  // namespace sluice::ice::classic_original_test
