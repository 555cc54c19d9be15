// Friction and conduction with several materials: like fluids are one, conservation, the same bits
// for any cut, mirror images, nothing where they are off.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ice/mixture/mixture_test_support.hpp"

namespace sluice::ice {
namespace {

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8, 588.33);  // 300 K at 1 bar

GasBox box_of(IntVec3 cells, bool periodic) {
  GasBox box;
  box.cells = cells;
  box.scheme = "conservative";
  box.periodic = periodic;
  box.walls = !periodic;
  return box;
}

// A shear wave and a wave of temperature at low speed.
MixtureCell waves(Vec3 x, const std::vector<double>& volume) {
  constexpr double k = 2 * std::numbers::pi;
  MixtureCell c;
  const double rho = 1 / (1 + .2 * std::sin(k * x.x) * std::cos(k * x.y));
  c.volume = volume;
  c.density.assign(volume.size(), rho);
  c.pressure.assign(volume.size(), 1.0);
  c.velocity[0] = .05 * std::sin(k * x.y);
  c.velocity[1] = .05 * std::sin(k * x.x);
  return c;
}

struct Difference {
  double velocity = 0, energy = 0, change = 0;
};
// Of a mixture from one gas, and how much the gas has changed.
Difference from_one_gas(const std::function<std::vector<double>(Vec3)>& shares, double exchange) {
  const GasBox box = box_of({24, 20, 1}, true);
  const Fluid gas = ideal_gas(1.4, 1);
  MixtureBox one(box, {gas}, [](Vec3 x) { return waves(x, {1.0}); }, {}, {}, {{.01}, {.02}, 0});
  MixtureBox two(box, {gas, gas}, [&](Vec3 x) { return waves(x, shares(x)); }, {}, {},
                 {{.01, .01}, {.02, .02}, exchange});
  MixtureBox start(box, {gas}, [](Vec3 x) { return waves(x, {1.0}); });
  for (int n = 0; n < 60; ++n) {
    const double dt = .4 / 24 / 1.3;
    one.step(dt);
    two.step(dt);
  }
  Difference d;
  for_each_cell(one.domain(), [&](IntVec3 c) {
    const double e = two.energy(0, c) + two.energy(1, c);
    d.velocity = std::fmax(d.velocity, std::fabs(two.velocity(c) - one.velocity(c)));
    d.energy = std::fmax(d.energy, std::fabs(e - one.energy(0, c)) / one.energy(0, c));
    d.change = std::fmax(d.change, std::fabs(one.velocity(c) - start.velocity(c)));
  });
  return d;
}

TEST(MixtureTransport, LikeFluidsAreOneFluid) {
  constexpr double round_off = 1e-12;
  const Difference uniform = from_one_gas([](Vec3) { return std::vector{.3, .7}; }, 0);
  std::printf("uniform shares: u %.2e E %.2e of change %.2e\n", uniform.velocity, uniform.energy,
              uniform.change);
  EXPECT_GT(uniform.change, 1e-2);
  EXPECT_LE(uniform.velocity, round_off);
  EXPECT_LE(uniform.energy, round_off);
}

// Water, air and a heavy gas, shocks, friction, conduction and heat exchange in a closed box.
MixtureCell three(Vec3 x) {
  MixtureCell c;
  const bool left = x.x + .2 * std::sin(6 * x.y) < .5, low = x.y < .45;
  c.volume = {left ? 1.0 : 0.0, !left && low ? 1.0 : 0.0, !left && !low ? 1.0 : 0.0};
  c.density = {1000, 1.2, 4};
  c.pressure = {x.x < .25 ? 3e8 : 1e5, 1e5, 2e5};
  return c;
}
const Transport all_three{{1e3, 20, 0}, {6e5, 2e3, 1e4}, 1e8};

TEST(MixtureTransport, AClosedBoxKeepsMassAndEnergy) {
  constexpr double limit = 1e-13;
  MixtureBox run(box_of({32, 24, 1}, false), {water, air, heavy}, three, {}, {}, all_three);
  const Totals before = run.totals();
  run.steps(1000);
  const Totals after = run.totals();
  for (std::size_t m = 0; m < 3; ++m)
    EXPECT_LE(std::fabs(after.mass[m].sum.value() - before.mass[m].sum.value()),
              limit * before.mass[m].sum.value());
  const double e0 = before.internal_energy.sum.value() + before.kinetic_energy.sum.value();
  const double e1 = after.internal_energy.sum.value() + after.kinetic_energy.sum.value();
  std::printf("dE/E %.2e, rejected %d, time %g\n", (e1 - e0) / e0, run.rejected(), run.time());
  EXPECT_LE(std::fabs(e1 - e0), limit * e0);
}

TEST(MixtureTransport, BlocksBoxesAndKindsLeaveNoTrace) {
  const auto run_with = [&](const SolverOptions& options, IntVec3 boxes) {
    MixtureBox run(box_of({48, 40, 1}, false), {water, air, heavy}, three, options, boxes,
                   all_three);
    run.steps(40);
    return bits_of(run, false);
  };
  expect_same_bits_however_cut(run_with);
}

TEST(MixtureTransport, MirroredStartsGiveMirroredBits) {
  for (const int ny : {1, 16}) {
    const auto start = [](double x, double y) {
      MixtureCell c = three({x + .5, y + .5, .5});
      c.velocity[1] = 5;
      return c;
    };
    GasBox box = box_of({48, ny, 1}, false);
    box.low = {-.5, -.5, -.5};
    box.high = {.5, .5, .5};
    MixtureBox run(
        box, {water, air, heavy}, [&](Vec3 x) { return start(x.x, x.y); }, {}, {}, all_three);
    MixtureBox image(
        box, {water, air, heavy}, [&](Vec3 x) { return start(-x.x, x.y); }, {}, {}, all_three);
    run.steps(60);
    image.steps(60);
    EXPECT_EQ(bits_of(run, false), bits_of(image, true)) << ny;
  }
}

bool has_task(const Ice& ice, int kind, const std::string& part) {
  TaskList list;
  StepVariant variant;
  variant.kind = kind;
  ice.declare_step(list, variant);
  for (const Task& task : list.tasks())
    if (task.name.find(part) != std::string::npos) return true;
  return false;
}

TEST(MixtureTransport, WhatIsOffAddsNoTask) {
  const auto with = [](const Transport& transport) {
    return MixtureBox(
        box_of({8, 8, 1}, true), {water, air},
        [](Vec3) {
          return MixtureCell{{0, 1}, {1000, 1}, {1e5, 1e5}, {}, {}};
        },
        {}, {}, transport);
  };
  const std::string friction[] = {"stress", "viscosity", "heat of friction"};
  const std::string heat[] = {"heat flux", "contacts", "temperature", "heat of friction"};
  const MixtureBox off = with({});
  for (const int kind : {0, 1, 2})
    for (const auto& names : {std::vector(std::begin(friction), std::end(friction)),
                              std::vector(std::begin(heat), std::end(heat))})
      for (const std::string& name : names) EXPECT_FALSE(has_task(off.ice(), kind, name)) << name;
  // Air conducts, water rubs: each kind of block has what its material needs.
  const MixtureBox some = with({{1, 0}, {0, 1}, 0});
  EXPECT_TRUE(has_task(some.ice(), 0, "stress"));
  EXPECT_FALSE(has_task(some.ice(), 0, "heat flux"));
  EXPECT_FALSE(has_task(some.ice(), 1, "stress"));
  EXPECT_TRUE(has_task(some.ice(), 1, "heat flux"));
  for (const char* name : {"stress", "viscosity", "contacts", "heat of friction"})
    EXPECT_TRUE(has_task(some.ice(), 2, name)) << name;
}

}  // namespace
}  // namespace sluice::ice
