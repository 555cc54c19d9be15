// Materials with velocities of their own: exchange alone, clouds, shocks, and what must not change.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/riemann/material_riemann.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::slip_test {
namespace {

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8);

using Start = std::function<MixtureCell(Vec3)>;

GasBox tube(IntVec3 cells, bool periodic = false) {
  GasBox box;
  box.cells = cells;
  box.periodic = periodic;
  box.walls = !periodic;
  box.scheme = "conservative";
  return box;
}
double momentum(const Totals& t) {
  return t.momentum[0].sum.value();
}

TEST(Slip, ExchangeAloneIsTheExponential) {
  const double Ma = 300, Mb = .7, slip = 1e-3;
  for (const double K : {0., 1., 1e3, 1e5, 1e7, 9e9}) {
    MixtureBox run(
        tube({8, 1, 1}, true), {water, air},
        [&](Vec3) {
          MixtureCell c = pair_at_rest(.3, 1000, 1, 1e5);
          c.slip = {slip, 0};
          return c;
        },
        {}, {}, {}, K);
    const Totals before = run.totals();
    run.steps(3);
    const double exact = slip * std::exp(-K * .21 * (1 / Ma + 1 / Mb) * run.time());
    const double now = run.velocity_of(0, {3, 0, 0}) - run.velocity_of(1, {3, 0, 0});
    EXPECT_NEAR(now, exact, 1e-9 * exact + 1e-16) << K;
    const Totals after = run.totals();
    EXPECT_LE(std::fabs(momentum(after) - momentum(before)), 1e-15 * momentum(before));
    EXPECT_LE(std::fabs(total_energy(after) - total_energy(before)), 1e-15 * total_energy(before));
  }
}

// The kinetic energy that drag takes is heat.
TEST(Slip, DragHeats) {
  MixtureBox run(
      tube({4, 1, 1}, true), {heavy, air},
      [](Vec3) {
        MixtureCell c = pair_at_rest(.4, 3, 1, 1);
        c.slip = {1, -2};
        return c;
      },
      {}, {}, {}, 1e3);
  const Totals before = run.totals();
  run.run(.05);
  const Totals after = run.totals();
  const double lost = .5 * (1.2 * .6 / 1.8) * 9;  // reduced mass, slip squared
  EXPECT_NEAR(before.kinetic_energy.sum.value() - after.kinetic_energy.sum.value(), lost, 1e-12);
  EXPECT_NEAR(after.internal_energy.sum.value() - before.internal_energy.sum.value(), lost, 1e-12);
}

struct Cloud {
  double moved, speed;
};
Cloud fly(double K, double time) {
  const int n = 200;
  MixtureBox run(
      tube({n, 1, 1}, true), {water, air},
      [](Vec3 x) {
        const bool in = x.x > .3 && x.x < .5;
        MixtureCell c = pair_at_rest(in ? .01 : 0.0, 1000, 1.2, 1e5);
        c.slip = {50, 0};
        return c;
      },
      {}, {}, {}, K);
  const Totals before = run.totals();
  run.run(time);
  EXPECT_EQ(run.rejected(), 0);
  double M = 0, x = 0, P = 0;
  for (int i = 0; i < n; ++i) {
    const double m = run.mass(0, {i, 0, 0});
    M += m;
    x += m * (i + .5) / n;
    P += m * run.velocity_of(0, {i, 0, 0});
  }
  const Totals after = run.totals();
  EXPECT_LE(std::fabs(momentum(after) - momentum(before)), 4e-15 * momentum(before)) << K;
  EXPECT_LE(std::fabs(total_energy(after) - total_energy(before)), 4e-15 * total_energy(before))
      << K;
  return {x / M - .4, P / M};
}

// Free flight of drops is .2. Weak drag: du/dt = -K V_a/M_d (u - u_gas) per drop, the gas at rest.
TEST(Slip, DropsFlyFreeAndAreSlowed) {
  const double time = .004;
  const Cloud free = fly(0, time), slow = fly(1e3, time), dragged = fly(1e5, time);
  std::printf("moved %.4f %.4f %.4f, at %.3f %.3f %.3f\n", free.moved, slow.moved, dragged.moved,
              free.speed, slow.speed, dragged.speed);
  EXPECT_NEAR(free.moved, .2, 1e-3);
  EXPECT_NEAR(free.speed, 50, .01);
  EXPECT_NEAR(slow.speed, 50 * std::exp(-1e3 * .99 / 1000 * time), .05);
  EXPECT_GT(slow.moved, dragged.moved);
  EXPECT_GT(free.moved, slow.moved);
  EXPECT_LT(dragged.speed, 40);
}

TEST(Slip, UniformFlowStaysUniform) {
  constexpr double limit = 1e-10;
  for (const double K : {0., 100., 1e8})
    for (const int ny : {1, 24}) {
      MixtureBox run(
          tube({40, ny, 1}, true), {water, air},
          [&](Vec3 x) {
            const bool in = std::fabs(x.x - .5) < .2 && (ny == 1 || std::fabs(x.y - .5) < .2);
            MixtureCell c;
            c.volume = {in ? .9 : 0.0, in ? .1 : 1.0};
            c.density = {1000, 1.2};
            c.pressure = {1e5, 1e5};
            c.velocity[0] = 100;
            c.velocity[1] = ny == 1 ? 0 : -40;
            return c;
          },
          {}, {}, {}, K);
      run.steps(ny == 1 ? 400 : 60);
      double du = 0, dp = 0;
      for_each_cell(run.domain(), [&](IntVec3 c) {
        for (int m = 0; m < 2; ++m)
          du = std::fmax(du, std::fabs(run.velocity_of(m, c) - 100) / 100);
        dp = std::fmax(dp, std::fabs(run.pressure(c) - 1e5) / 1e5);
      });
      std::printf("K %g, ny %d: du/u %.2e dp/p %.2e\n", K, ny, du, dp);
      EXPECT_LE(du, limit);
      EXPECT_LE(dp, limit);
    }
}

struct Problem {
  const char* name;
  Fluid left, right;
  double rho_l, p_l, rho_r, p_r, x0, t;
};

double density_error(const Problem& p, int n, double K) {
  GasBox box = tube({n, 1, 1});
  box.walls = false;
  MixtureBox run(
      box, {p.left, p.right},
      [&](Vec3 x) {
        const bool left = x.x < p.x0;
        MixtureCell c;
        c.volume = {left ? 1.0 : 0.0, left ? 0.0 : 1.0};
        c.density = {p.rho_l, p.rho_r};
        c.pressure = {p.p_l, p.p_r};
        return c;
      },
      {}, {}, {}, K);
  run.run(p.t);
  EXPECT_EQ(run.rejected(), 0) << p.name << " " << K;
  const exact::MaterialRiemann solution(
      {p.left.law, exact::state_of_pressure(p.left.law, p.rho_l, 0, p.p_l)},
      {p.right.law, exact::state_of_pressure(p.right.law, p.rho_r, 0, p.p_r)});
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    sum += std::fabs(run.density({i, 0, 0}) - solution.sample((x - p.x0) / p.t).state.density) / n;
  }
  return sum;
}

// Unmixed materials meet at strong jumps: with and without drag as if they had one velocity.
TEST(Slip, InterfacesHoldAtStrongJumpsWithoutDrag) {
  const Problem problems[] = {
      {"gases", air, heavy, 1, 1, .125, .1, .5, .2},
      {"strong", air, heavy, 1, 500, 1, .2, .5, .01},
      {"water-air 50", water, air, 1000, 1e9, 50, 1e5, .7, 2.4e-4},
      {"water-air 1.2", water, air, 1000, 1e9, 1.2, 1e5, .7, 1.2e-4},
  };
  for (const Problem& p : problems) {
    const double one = density_error(p, 200, one_velocity_coefficient);
    for (const double K : {1e8, 1e3, 0.}) {
      const double error = density_error(p, 200, K);
      std::printf("%s, K %g: %.3f of that of one velocity\n", p.name, K, error / one);
      EXPECT_LT(error, 1.03 * one) << p.name << " " << K;
    }
  }
}

// Clouds of drops and a slab, moving against the gas: everything that slip does.
Start busy(bool turned) {
  return [turned](Vec3 x) {
    const double s = turned ? -x.x : x.x;
    const double V = s > -.4 && s < -.1 ? .02 : s > .1 && s < .3 && x.y < .2 ? 1.0 : 0.0;
    MixtureCell c = pair_at_rest(V, 1000, 1.2, s < -.3 ? 1e6 : 1e5);
    c.velocity[0] = turned ? -20 : 20;
    c.velocity[1] = 5;
    c.slip = {turned ? -60. : 60., 0};
    return c;
  };
}
// Two viscous fluids in every cell, a shear wave in one of them that drags the other along:
//   M_m u_m' = -V_m mu_m k^2 u_m + K V_a V_b (u_n - u_m)
double shear_error(int n, double K) {
  const double A = 1e-2, V = .4, Ma = .4 * 3, Mb = .6, mu_a = .05, mu_b = .2, time = .5;
  const double k2 = 4 * M_PI * M_PI;
  Transport transport;
  transport.viscosity = {mu_a, mu_b};
  MixtureBox run(
      tube({4, n, 1}, true), {heavy, air},
      [&](Vec3 x) {
        MixtureCell c = pair_at_rest(V, 3, 1, 1);
        c.slip = {A * std::sin(2 * M_PI * x.y), 0};
        return c;
      },
      {}, {}, transport, K);
  run.run(time);
  double u[2] = {A, 0};
  const int steps = 20000;
  for (int s = 0; s < steps; ++s) {  // the midpoint rule
    const auto rate = [&](const double* v, int m) {
      const double pull = K * V * (1 - V) * (m == 0 ? v[1] - v[0] : v[0] - v[1]);
      return m == 0 ? (pull - V * mu_a * k2 * v[0]) / Ma : (pull - (1 - V) * mu_b * k2 * v[1]) / Mb;
    };
    const double h = time / steps;
    const double half[2] = {u[0] + .5 * h * rate(u, 0), u[1] + .5 * h * rate(u, 1)};
    const double next[2] = {u[0] + h * rate(half, 0), u[1] + h * rate(half, 1)};
    u[0] = next[0];
    u[1] = next[1];
  }
  double worst = 0;
  for (int j = 0; j < n; ++j)
    for (int m = 0; m < 2; ++m)
      worst = std::fmax(worst, std::fabs(run.velocity_of(m, {2, j, 0}) -
                                         u[m] * std::sin(2 * M_PI * (j + .5) / n)));
  return worst / A;
}
TEST(Slip, ShearOfTwoFluidsFallsAsEachRubsAndBothDrag) {
  for (const double K : {0., 5., 1e4}) {
    const double coarse = shear_error(16, K), fine = shear_error(32, K);
    const double order = std::log2(coarse / fine);
    std::printf("K %g: errors %.2e %.2e, order %.2f\n", K, coarse, fine, order);
    EXPECT_LT(fine, 4e-3) << K;
    EXPECT_GT(order, 1.6) << K;
  }
}

// Friction, conduction, heat exchange and drag between walls: nothing is lost.
TEST(Slip, ClosedBoxWithAllTransportKeepsEnergy) {
  Transport transport;
  transport.viscosity = {2, .5};
  transport.conductivity = {600, 30};
  transport.heat_exchange = 1e6;
  MixtureBox run(tube({24, 24, 1}), {water, air}, busy(false), {}, {}, transport, 100);
  const Totals before = run.totals();
  run.steps(200);
  const Totals after = run.totals();
  for (std::size_t m = 0; m < 2; ++m)
    EXPECT_NEAR(after.mass[m].sum.value() / before.mass[m].sum.value(), 1, 4e-15);
  EXPECT_NEAR(total_energy(after) / total_energy(before), 1, 2e-14);
  EXPECT_EQ(run.rejected(), 0);
}

struct Hard {
  const char* name;
  Fluid a, b;
  IntVec3 cells;
  double time;
  Start start;
};

std::vector<Hard> hard_cases() {
  std::vector<Hard> all;
  for (const double theta : {1e-5, .01, .3, .9})
    all.push_back({"shock into drops", water, air, {200, 1, 1}, 3e-3, [theta](Vec3 x) {
                     const bool shocked = x.x < .2;
                     return pair_at_rest(std::fabs(x.x - .5) < .1 ? theta : 0.0, 1000,
                                         shocked ? 12 : 1.2, shocked ? 2e6 : 1e5);
                   }});
  for (const double theta : {.01, .3})
    all.push_back({"shock into bubbles", air, water, {200, 1, 1}, 3e-4, [theta](Vec3 x) {
                     return pair_at_rest(std::fabs(x.x - .5) < .1 ? theta : 0.0, 1.2, 1000,
                                         x.x < .2 ? 1e9 : 1e5);
                   }});
  for (const double way : {1., -1.})
    all.push_back({"streams of drops", water, air, {100, 1, 1}, 4e-3, [way](Vec3 x) {
                     MixtureCell c = pair_at_rest(.1, 1000, 1.2, 1e5);
                     c.slip = {x.x < .5 ? 100 * way : -100 * way, 0};
                     return c;
                   }});
  all.push_back({"mixed gases", air, heavy, {200, 1, 1}, .2, [](Vec3 x) {
                   return pair_at_rest(x.x < .5 ? .7 : .2, 1, .3, x.x < .5 ? 10 : .1);
                 }});
  all.push_back({"near vacuum", water, air, {100, 1, 1}, 1e-3, [](Vec3 x) {
                   const bool left = x.x < .5;
                   return pair_at_rest(left ? .01 : 1e-6, 1000, left ? 1.2 : 1e-6, left ? 1e5 : .1);
                 }});
  all.push_back({"shock around a column", water, air, {48, 48, 1}, 2e-4, [](Vec3 x) {
                   const bool shocked = x.x < .2;
                   return pair_at_rest(std::hypot(x.x - .6, x.y - .5) < .2 ? 1 : 0, 1000,
                                       shocked ? 50 : 1.2, shocked ? 1e8 : 1e5);
                 }});
  return all;
}

void expect_hard_cases_to_finish(std::initializer_list<double> drags) {
  for (const Hard& h : hard_cases())
    for (const double K : drags) {
      MixtureBox run(tube(h.cells), {h.a, h.b}, h.start, {}, {}, {}, K);
      const Totals before = run.totals();
      run.run(h.time);
      const Totals after = run.totals();
      for (std::size_t m = 0; m < 2; ++m)
        EXPECT_NEAR(after.mass[m].sum.value() / before.mass[m].sum.value(), 1, 4e-15) << h.name;
      EXPECT_NEAR(total_energy(after) / total_energy(before), 1, 1e-13) << h.name << " " << K;
      EXPECT_EQ(run.rejected(), 0) << h.name << " " << K;
    }
}

TEST(Slip, HardCasesFinish) {
  expect_hard_cases_to_finish({100});
}
TEST(Slip, FullHardCasesFinish) {
  expect_hard_cases_to_finish({0, 1e6});
}

GasBox around_zero(int nx, int ny) {
  GasBox box = tube({nx, ny, 1});
  box.low = {-.5, -.5, -.5};
  box.high = {.5, .5, .5};
  return box;
}
TEST(Slip, MirroredStartsGiveMirroredBits) {
  for (const int ny : {1, 16})
    for (const double K : {0., 1e4}) {
      MixtureBox run(around_zero(64, ny), {water, air}, busy(false), {}, {}, {}, K);
      MixtureBox image(around_zero(64, ny), {water, air}, busy(true), {}, {}, {}, K);
      run.steps(50);
      image.steps(50);
      EXPECT_EQ(bits_of(run, false), bits_of(image, true)) << ny << " " << K;
    }
}

TEST(Slip, BlocksBoxesAndKindsLeaveNoTrace) {
  const auto run_with = [&](const SolverOptions& options, IntVec3 boxes) {
    MixtureBox run(around_zero(48, 40), {water, air}, busy(false), options, boxes, {}, 1e3);
    run.steps(40);
    return bits_of(run, false);
  };
  expect_same_bits_however_cut(run_with);
}

// One velocity: no field and no task of slip.
TEST(Slip, CostsNothingWhereAllMoveTogether) {
  const auto look = [](double K) {
    MixtureBox run(
        around_zero(32, 16), {water, air},
        [](Vec3 x) { return pair_at_rest(x.x < 0 ? 1 : 0, 1000, 1.2, 1e5); }, {}, {}, {}, K);
    run.steps(2);
    int slots = 0;
    for (const SlotInfo& slot : run.ice().state().slots()) slots += slot.label == labels().slip;
    return std::pair{slots, run.solver().graphs().effect_tasks()[effect_momentum_exchange]};
  };
  EXPECT_EQ(look(one_velocity_coefficient), (std::pair{0, 0}));
  const auto [slots, tasks] = look(1e9);
  EXPECT_EQ(slots, 2);
  EXPECT_GT(tasks, 0);
}

}  // namespace
}  // namespace sluice::ice::slip_test
