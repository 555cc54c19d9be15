// What tests of friction and conduction in mixtures start from.
#pragma once
#include <cmath>
#include <numbers>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice {

inline const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
inline const Fluid water = stiffened_gas(4.4, 6e8, 588.33);  // 300 K at 1 bar

// Shear waves of this speed and a wave of temperature.
inline MixtureCell waves(Vec3 x, const std::vector<double>& volume, double speed) {
  constexpr double k = 2 * std::numbers::pi;
  MixtureCell c;
  const double rho = 1 / (1 + .2 * std::sin(k * x.x) * std::cos(k * x.y));
  c.volume = volume;
  c.density.assign(volume.size(), rho);
  c.pressure.assign(volume.size(), 1.0);
  c.velocity[0] = speed * std::sin(k * x.y);
  c.velocity[1] = speed * std::sin(k * x.x);
  return c;
}
// In a mean flow.
inline MixtureCell moving_waves(Vec3 x, const std::vector<double>& volume) {
  MixtureCell c = waves(x, volume, .2);
  c.velocity[0] += .1;
  return c;
}
// Water with a shock, air and a heavy gas.
inline MixtureCell three(Vec3 x) {
  MixtureCell c;
  const bool left = x.x + .2 * std::sin(6 * x.y) < .5, low = x.y < .45;
  c.volume = {left ? 1.0 : 0.0, !left && low ? 1.0 : 0.0, !left && !low ? 1.0 : 0.0};
  c.density = {1000, 1.2, 4};
  c.pressure = {x.x < .25 ? 3e8 : 1e5, 1e5, 2e5};
  return c;
}

// `walls`: of a box that is not periodic, GasBox::walls or GasBox::plates.
inline GasBox box_of(IntVec3 cells, bool periodic, bool GasBox::*walls) {
  GasBox box;
  box.cells = cells;
  box.scheme = "conservative";
  box.periodic = periodic;
  box.*walls = !periodic;
  return box;
}

inline void expect_closed_box_keeps_mass_and_energy(bool GasBox::*walls, const Transport& transport,
                                                    int steps) {
  constexpr double limit = 1e-13;  // measured 2.9e-16 of the energy
  MixtureBox run(box_of({32, 24, 1}, false, walls), {water, air, heavy}, three, {}, {}, transport);
  const Totals before = run.totals();
  run.steps(steps);
  std::printf("rejected %d, time %g, ", run.rejected(), run.time());
  expect_kept(before, run.totals(), limit);
}

inline void expect_same_bits_of_three(bool GasBox::*walls, const Transport& transport, int steps) {
  expect_same_bits_however_cut([&](const SolverOptions& options, IntVec3 boxes) {
    MixtureBox run(box_of({48, 40, 1}, false, walls), {water, air, heavy}, three, options, boxes,
                   transport);
    run.steps(steps);
    return bits_of(run, false);
  });
}

// In a box about 0, which is mirrored about x = 0 with all that `transport` places in it.
inline void expect_mirrored_bits_of_three(bool GasBox::*walls, int ny, const Transport& transport,
                                          int steps) {
  GasBox box = box_of({48, ny, 1}, false, walls);
  box.low = {-.5, -.5, -.5};
  box.high = {.5, .5, .5};
  const auto bits = [&](double way, bool mirror) {
    const auto start = [way](Vec3 x) {
      MixtureCell c = three({way * x.x + .5, x.y + .5, .5});
      c.velocity[1] = 5;
      return c;
    };
    MixtureBox run(box, {water, air, heavy}, start, {}, {}, transport);
    run.steps(steps);
    return bits_of(run, mirror);
  };
  EXPECT_EQ(bits(1, false), bits(-1, true)) << ny;
}

// Names of the tasks of a step of water and air, in blocks of a kind.
inline std::string tasks_of(const Transport& transport, int kind) {
  const MixtureBox run(
      box_of({8, 8, 1}, true, &GasBox::walls), {water, air},
      [](Vec3) {
        return MixtureCell{{0, 1}, {1000, 1}, {1e5, 1e5}, {}, {}};
      },
      {}, {}, transport);
  TaskList list;
  StepVariant variant;
  variant.kind = kind;
  run.ice().step().declare(list, variant);
  std::string names;
  for (const Task& task : list.tasks()) names += task.name + "; ";
  return names;
}

}  // namespace sluice::ice
