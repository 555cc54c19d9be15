// Strong shocks along the grid stay straight; what the cure exchanges is conserved, and is nothing
// where no shock is.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::shock_shear_test {
namespace {

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);

GasBox closed(IntVec3 cells) {
  GasBox box;
  box.cells = cells;
  box.high = {cells.x / 10.0, cells.y / 10.0, cells.z / 10.0};
  box.periodic = false;
  box.walls = true;
  box.scheme = "conservative";
  return box;
}

// A tube with a thousandth of the pressure ahead; rows differ in density there by `seed`.
MixtureCell strong_tube(Vec3 x, double seed, int materials) {
  const bool driver = x.x < 1.5, odd = static_cast<int>(std::floor(x.y * 10)) % 2 == 1;
  const bool first = materials == 1 || driver;
  const double rho = 1.4 * (1 + (driver || odd ? 0.0 : seed)), p = driver ? 1000.0 : 1.0;
  MixtureCell c;
  c.volume = {first ? 1.0 : 0.0};
  c.density = {rho};
  c.pressure = {p};
  if (materials == 2) {
    c.volume.push_back(first ? 0.0 : 1.0);
    c.density.push_back(rho);
    c.pressure.push_back(p);
  }
  return c;
}

// Of the components from `first` to before `end`.
double fastest(const MixtureBox& run, int first, int end) {
  double most = 0;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    for (int d = first; d < end; ++d) most = std::fmax(most, std::fabs(run.velocity(c, d)));
  });
  return most;
}

// What differs ahead by a seed differs behind by a few seeds of the flow's speed; where the shock
// breaks into rows, whatever the seed, by the speed of sound ahead and more.
TEST(ShockShear, RowsBehindAShockStayAlike) {
  constexpr double seed = 1e-4;
  for (const int materials : {1, 2}) {
    for (const IntVec3 cells : {IntVec3{80, 6, 1}, IntVec3{40, 4, 4}}) {
      SCOPED_TRACE(std::to_string(materials) + " materials, planes " + std::to_string(cells.z));
      const std::vector<Fluid> fluids =
          materials == 1 ? std::vector<Fluid>{air} : std::vector<Fluid>{air, heavy};
      MixtureBox run(closed(cells), fluids,
                     [&](Vec3 x) { return strong_tube(x, seed, materials); });
      run.run((cells.x / 10.0 - 3) / 9);
      const double along = fastest(run, 0, 1);
      EXPECT_GT(along, 5);
      EXPECT_LT(fastest(run, 1, run.level().active_count()), 5 * seed * along);
    }
  }
}

// Across the shock 1000:1, with rows that move against each other.
TEST(ShockShear, KeepsMassMomentumAndEnergy) {
  constexpr double limit = 1e-13;
  for (const int materials : {1, 2}) {
    const std::vector<Fluid> fluids =
        materials == 1 ? std::vector<Fluid>{air} : std::vector<Fluid>{air, heavy};
    GasBox box = closed({40, 12, 1});
    box.periodic = true;
    MixtureBox run(box, fluids, [&](Vec3 x) {
      MixtureCell c = strong_tube(x, 0.1, materials);
      c.velocity[0] = 2 * std::sin(40 * x.y);
      c.velocity[1] = std::cos(7 * x.x);
      return c;
    });
    const Totals before = run.totals();
    run.steps(60);
    const Totals after = run.totals();
    expect_kept(before, after, limit);
    for (int d = 0; d < 2; ++d)  // there are gases of 1.4 kg/m^3 at up to 30 m/s in 4.8 m^3
      EXPECT_NEAR(after.momentum[d].sum.value(), before.momentum[d].sum.value(), 200 * limit);
  }
}

// Whatever boxes and blocks the rows are cut into, though rows are looked at in parts.
TEST(ShockShear, SameBitsHoweverCut) {
  for (const int materials : {1, 2}) {
    const std::vector<Fluid> fluids =
        materials == 1 ? std::vector<Fluid>{air} : std::vector<Fluid>{air, heavy};
    expect_same_bits_however_cut([&](const SolverOptions& options, IntVec3 boxes) {
      MixtureBox run(
          closed({80, 24, 1}), fluids, [&](Vec3 x) { return strong_tube(x, 0.1, materials); },
          options, boxes);
      run.steps(60);
      return bits_of(run, false);
    });
  }
}

// Layers that slide along each other under one pressure do so for ever, to the bit.
TEST(ShockShear, LeavesSlipLinesAlone) {
  GasBox box = closed({16, 12, 1});
  box.periodic = true;
  MixtureBox run(box, {air}, [](Vec3 x) {
    MixtureCell c;
    c.volume = {1};
    c.density = {1};
    c.pressure = {1};
    c.velocity[0] = x.y < .6 ? 4 : -4;
    return c;
  });
  run.steps(50);
  for_each_cell(run.domain(), [&](IntVec3 c) {
    EXPECT_EQ(run.velocity(c), c.y < 6 ? 4 : -4);
    EXPECT_EQ(run.velocity(c, 1), 0);
  });
}

}  // namespace
}  // namespace sluice::ice::shock_shear_test
