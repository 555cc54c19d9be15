// A gas that slips along the surface of another material, each with a velocity of its own: the drag
// in its parts along and across, what is kept, mirror images, the same bits for any cut.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/closure/drag.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::slip_surface_test {
namespace {

using mixture::ByMaterial;
using mixture::Drag;
using mixture::DragCell;

constexpr int directions = 3;

// Solid, gas and, if there are three, something else.
DragCell surface_cell(int count, double share, double passes, const double* normal) {
  const double M[] = {500, .6, 2}, V[] = {.5, .3, .2};
  DragCell cell;
  cell.count = count;
  for (int m = 0; m < count; ++m) {
    cell.index[m] = m;
    cell.M[m] = M[m];
    cell.V[m] = V[m];
    cell.bind[m] = 0;
    cell.total += M[m];
  }
  cell.lock = 1e12;
  cell.surface = share;
  cell.passes = passes;
  std::copy_n(normal, directions, cell.normal);
  return cell;
}
Drag drag_of(double K, int count) {
  PairCoefficients k(count);
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) k.set(a, b, K);
  MultiVelocityExchange slip;
  slip.fluid = 1;
  slip.solid = 0;
  return Drag(k, slip);
}
// Velocities without momentum.
void start(const DragCell& cell, ByMaterial* w) {
  for (int c = 0; c < directions; ++c) {
    double sum = 0;
    for (int m = 0; m < cell.count; ++m) sum += cell.M[m] * (w[c][m] = 10. * c + 7 * m * m - 3 * m);
    for (int m = 0; m < cell.count; ++m) w[c][m] -= sum / cell.total;
  }
}
double dot(const double* n, const ByMaterial* w, int a, int b) {
  double sum = 0;
  for (int c = 0; c < directions; ++c) sum += n[c] * (w[c][a] - w[c][b]);
  return sum;
}

const double normals[][3] = {{0, -1, 0}, {.6, .8, 0}, {2. / 3, -1. / 3, 2. / 3}};

// Across nothing is left, along it falls as coefficient and surface one after the other let it.
TEST(SlipSurface, HoldsAcrossAndSlipsAlong) {
  const double dt = 1e-3, h = 40;
  for (const double* n : normals)
    for (const double K : {0., 1e3, 1e9, 1e20}) {
      const DragCell cell = surface_cell(2, 1, h, n);
      double w[directions][max_materials], before[directions][max_materials];
      start(cell, w);
      start(cell, before);
      drag_of(K, 2).decay(cell, dt, 1, directions, w);
      const double both = K > 0 ? 1 / (1 / (K * .5 * .3) + 1 / h) : 0;
      const double left = std::exp(-dt * both * (1 / cell.M[0] + 1 / cell.M[1]));
      EXPECT_NEAR(dot(n, w, 0, 1), 0, 1e-12) << K;
      for (int c = 0; c < directions; ++c) {
        const double along = before[c][0] - before[c][1] - n[c] * dot(n, before, 0, 1);
        EXPECT_NEAR(w[c][0] - w[c][1], along * left, 1e-12) << K;
        EXPECT_NEAR(cell.M[0] * w[c][0] + cell.M[1] * w[c][1], 0, 1e-12) << K;
      }
    }
}

// Any coefficient: what is left is finite, has no momentum and less energy; a push sums to zero.
TEST(SlipSurface, KeepsMomentumAndTakesEnergyWithThreeMaterials) {
  for (const double* n : normals)
    for (const double K : {0., 1e-3, 1e6, 1e20})
      for (const double share : {0., .3, 1.}) {
        const DragCell cell = surface_cell(3, share, 1e4, n);
        double w[directions][max_materials], v[directions][max_materials];
        start(cell, w);
        const auto energy = [&] {
          double sum = 0;
          for (const auto& one : w) sum += Drag::energy(cell, one);
          return sum;
        };
        const double before = energy();
        drag_of(K, 3).decay(cell, 1e-3, .5, directions, w);
        EXPECT_TRUE(std::isfinite(energy()));
        EXPECT_LE(energy(), before);
        double push[directions][max_materials];
        start(cell, push);
        for (auto& one : push)
          for (int m = 0; m < 3; ++m) one[m] *= cell.M[m];
        drag_of(K, 3).respond(cell, 1e-3, 1, directions, push, v);
        for (int c = 0; c < directions; ++c) {
          double sum = 0, given = 0, size = 0;
          for (int m = 0; m < 3; ++m) {
            sum += cell.M[m] * w[c][m];
            given += cell.M[m] * v[c][m];
            size += std::fabs(push[c][m]);
          }
          EXPECT_NEAR(sum, 0, 1e-15 * size);
          EXPECT_NEAR(given, 0, 1e-15 * size);
        }
      }
}

// A surface that lets everything pass is none but for the coefficient; one that lets nothing pass
// leaves what moves along it as it was.
TEST(SlipSurface, LimitsAreNoSlipAndFreeSlip) {
  const double dt = 1e-3, K = 1e5;
  const double* n = normals[1];
  const auto along = [&](double passes, double lock) {
    DragCell cell = surface_cell(2, 1, passes, n);
    cell.lock = lock;
    double w[directions][max_materials];
    start(cell, w);
    drag_of(K, 2).decay(cell, dt, 1, directions, w);
    return w[2][0] - w[2][1];
  };
  DragCell plain = surface_cell(2, 0, 0, n);
  plain.lock = 0;
  double w[directions][max_materials], first[directions][max_materials];
  start(plain, w);
  start(plain, first);
  drag_of(K, 2).decay(plain, dt, 1, directions, w);
  EXPECT_NEAR(along(1e30, 1e12), w[2][0] - w[2][1], 1e-13);
  EXPECT_NEAR(along(0, 1e12), first[2][0] - first[2][1], 1e-13);
}

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8, 588.33);

GasBox box_around_zero(IntVec3 cells) {
  GasBox box;
  box.cells = cells;
  box.low = {-.5, -.5, -.5};
  box.high = {.5, .5, .5};
  box.periodic = false;
  box.walls = true;
  box.scheme = "conservative";
  return box;
}
Transport slipping(double accommodation) {
  Transport t;
  t.viscosity = {20, .5, .2};
  t.conductivity = {600, 30, 10};
  t.heat_exchange = 1e8;
  t.change = [accommodation](ExchangeSettings& x) {
    MultiVelocityExchange slip;
    slip.fluid = 1;
    slip.solid = 0;
    slip.momentum_accommodation = slip.thermal_accommodation = accommodation;
    x.slip = slip;
  };
  return t;
}
// A drop of water with an edge that cells share, air that blows along it and behind a shock, a
// heavy gas above.
std::function<MixtureCell(Vec3)> windy(double way) {
  return [way](Vec3 x) {
    const double s = way * x.x, r = std::hypot(s - .05, x.y + .1);
    const double V = std::clamp((.22 - r) * 16 + .5, 0., 1.);
    const bool above = x.y > .3;
    MixtureCell c;
    c.volume = {V, above ? 0. : 1 - V, above ? 1 - V : 0.};
    c.density = {1000, s < -.3 ? 4. : 1.2, 3};
    const double p = s < -.3 ? 5e5 : 1e5;
    c.pressure = {p, p, p};
    c.velocity[0] = way * 10;
    c.velocity[1] = 15;
    c.slip = {0, way * 60, way * -20};
    return c;
  };
}

void expect_a_closed_box_to_keep(int steps) {
  constexpr double limit = 1e-14;  // measured 1.2e-16 of the energy
  for (const double K : {0., 1e3, 1e9})
    for (const double a : {1e-3, 1.}) {
      MixtureBox run(box_around_zero({32, 28, 1}), {water, air, heavy}, windy(1), {}, {},
                     slipping(a), K);
      const Totals before = run.totals();
      run.steps(steps);
      std::printf("K %g a %g: ", K, a);
      expect_kept(before, run.totals(), limit);
      EXPECT_EQ(run.rejected(), 0);
    }
}

TEST(SlipSurface, AClosedBoxKeepsMassAndEnergy) {
  expect_a_closed_box_to_keep(80);
}
TEST(SlipSurface, FullAClosedBoxKeepsMassAndEnergy) {
  expect_a_closed_box_to_keep(300);
}

// Without walls momentum stays, whatever passes the surface.
TEST(SlipSurface, APeriodicBoxKeepsMomentum) {
  GasBox box = box_around_zero({24, 24, 1});
  box.periodic = true;
  box.walls = false;
  MixtureBox run(box, {water, air, heavy}, windy(1), {}, {}, slipping(.4), 1e5);
  const Totals before = run.totals();
  run.steps(200);
  const Totals after = run.totals();
  for (std::size_t d = 0; d < 2; ++d)
    EXPECT_NEAR(after.momentum[d].sum.value() / before.momentum[d].sum.value(), 1, 1e-13);
}

TEST(SlipSurface, MirroredStartsGiveMirroredBits) {
  for (const double K : {0., 1e6}) {
    const auto bits = [&](double way, bool mirror) {
      MixtureBox run(box_around_zero({64, 32, 1}), {water, air, heavy}, windy(way), {}, {},
                     slipping(.3), K);
      run.steps(40);
      return bits_of(run, mirror);
    };
    EXPECT_EQ(bits(1, false), bits(-1, true)) << K;
  }
}

TEST(SlipSurface, BlocksBoxesAndKindsLeaveNoTrace) {
  const auto run_with = [&](const SolverOptions& options, IntVec3 boxes) {
    MixtureBox run(box_around_zero({48, 40, 1}), {water, air, heavy}, windy(1), options, boxes,
                   slipping(.3), 1e4);
    run.steps(20);
    return bits_of(run, false);
  };
  expect_same_bits_however_cut(run_with);
}

// A slab of heavy gas, air that flows past it: the more slips, the less of its velocity the slab
// takes; a coefficient without slip takes all.
TEST(SlipSurface, LessPassesTheMoreSlips) {
  const auto pulled = [&](const Transport& t) {
    GasBox box = box_around_zero({4, 32, 1});
    box.periodic = true;
    box.walls = false;
    MixtureBox run(
        box, {heavy, air},
        [](Vec3 x) {
          const double V = std::fabs(x.y) < .2 ? 1. : std::fabs(x.y) < .21 ? .5 : 0.;
          MixtureCell c = pair_at_rest(V, 20, 1, 1e5);
          c.slip = {0, 10};
          return c;
        },
        {}, {}, t, 1e9);
    run.run(.02);
    return run.velocity_of(0, {2, 16, 0});
  };
  Transport rubbing = slipping(1);
  rubbing.viscosity = {5, 2};
  rubbing.conductivity = {};
  const auto with = [&](double a) {
    Transport t = rubbing;
    t.change = slipping(a).change;
    return pulled(t);
  };
  Transport sticking = rubbing;
  sticking.change = {};
  const double none = with(1e-8), some = with(.1), all = with(1), stuck = pulled(sticking);
  std::printf("pulled to %.3e %.3e %.3e, without slip %.3e\n", none, some, all, stuck);
  EXPECT_LT(std::fabs(none), 1e-4 * stuck);
  EXPECT_LT(none, some);
  EXPECT_LT(some, all);
  EXPECT_LT(all, stuck);
}

// No field and no task of it where the deck has no slip.
TEST(SlipSurface, WhatIsOffAddsNoTask) {
  const auto tasks = [](const Transport& t) {
    MixtureBox run(box_around_zero({8, 8, 1}), {water, air, heavy}, windy(1), {}, {}, t, 1e3);
    TaskList list;
    StepVariant variant;
    variant.kind = 3;  // several materials
    run.ice().step().declare(list, variant);
    int with_surface = 0;
    for (const Task& task : list.tasks())
      with_surface += task.name.find("surface") != std::string::npos;
    return std::pair{list.tasks().size(), with_surface};
  };
  Transport off = slipping(1);
  off.change = {};
  EXPECT_EQ(tasks(slipping(1)).second, 1);
  EXPECT_EQ(tasks(off).second, 0);
  EXPECT_EQ(tasks(slipping(1)).first, tasks(off).first + 1);
}

}  // namespace
}  // namespace sluice::ice::slip_surface_test
