// Several materials: equilibrium, conservation, traces, mirror images, the same bits for any cut.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::mixture_flow_test {
namespace {

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8);

GasBox periodic(IntVec3 cells) {
  GasBox box;
  box.cells = cells;
  box.scheme = "conservative";
  return box;
}

// The first material between x = .3 and .7 (in 2-D a square), the second around it.
std::function<MixtureCell(Vec3)> slab(double rho_a, double rho_b, double p, Vec3 u, bool square) {
  return [=](Vec3 x) {
    const auto inside = [](double s) { return s > .3 && s < .7; };
    const bool in = inside(x.x) && (!square || inside(x.y));
    MixtureCell c = pair_at_rest(in ? 1.0 : 0.0, rho_a, rho_b, p);
    for (int d = 0; d < 3; ++d) c.velocity[d] = u[d];
    return c;
  };
}

struct Uniform {
  const char* name;
  Fluid a, b;
  double rho_a, rho_b, p, u;
  int cells_y;
};

TEST(MixtureFlow, PressureAndVelocityStayUniform) {
  constexpr double limit = 1e-10;
  const Uniform cases[] = {
      {"gases 1:10", air, heavy, 10, 1, 1, 1, 1},
      {"gases 1:1000", air, heavy, 1000, 1, 1, 1, 1},
      {"water in air", water, air, 1000, 1.2, 1e5, 100, 1},
      {"products in air", jwl(), air, 1840, 50, 2e10, 1000, 1},
      {"water in air, 2-D", water, air, 1000, 1.2, 1e5, 100, 40},
      {"gases, 2-D", air, heavy, 1000, 1, 1, 1, 40},
  };
  for (const Uniform& k : cases) {
    const bool flat = k.cells_y == 1;
    MixtureBox run(periodic({40, k.cells_y, 1}), {k.a, k.b},
                   slab(k.rho_a, k.rho_b, k.p, {k.u, flat ? 0.0 : -.4 * k.u, 0}, !flat));
    run.steps(flat ? 400 : 100);
    double du = 0, dp = 0;
    for_each_cell(run.domain(), [&](IntVec3 c) {
      du = std::fmax(du, std::fabs(run.velocity(c) - k.u) / k.u);
      dp = std::fmax(dp, std::fabs(run.pressure(c) - k.p) / k.p);
    });
    std::printf("%s: du/u %.2e dp/p %.2e at %g\n", k.name, du, dp, run.time());
    EXPECT_LE(du, limit) << k.name;
    EXPECT_LE(dp, limit) << k.name;
    EXPECT_EQ(run.rejected(), 0) << k.name;
  }
}

// Mass of each material, momentum and total energy of a closed or periodic box.
TEST(MixtureFlow, ConservesThroughShocks) {
  constexpr double limit = 1e-13;
  for (const int ny : {1, 24}) {
    GasBox box = periodic({60, ny, 1});
    box.periodic = false;
    box.walls = true;
    MixtureBox run(box, {water, air}, [](Vec3 x) {
      const bool left = x.x + .2 * std::sin(6 * x.y) < .6;
      MixtureCell c;
      c.volume = {left ? 1.0 : 0.0, left ? 0.0 : 1.0};
      c.density = {1000, 1.2};
      c.pressure = {x.x < .3 ? 1e9 : 1e5, 1e5};
      return c;
    });
    const Totals before = run.totals();
    run.steps(ny == 1 ? 1000 : 200);
    std::printf("ny %d: rejected %d, time %g, ", ny, run.rejected(), run.time());
    expect_kept(before, run.totals(), limit);
  }
}

TEST(MixtureFlow, MirroredStartsGiveMirroredBits) {
  for (const int ny : {1, 16}) {
    const auto start = [](double x, double y) {
      const bool left = x + .05 * y < -.1;
      MixtureCell c;
      c.volume = {left ? 1.0 : 0.0, left ? 0.0 : 1.0};
      c.density = {1000, 1.2};
      c.pressure = {1e8, 1e5};
      return c;
    };
    GasBox box = periodic({64, ny, 1});
    box.periodic = false;
    box.low = {-.5, -.5, -.5};
    box.high = {.5, .5, .5};
    MixtureBox run(box, {water, air}, [&](Vec3 x) { return start(x.x, x.y); });
    MixtureBox image(box, {water, air}, [&](Vec3 x) { return start(-x.x, x.y); });
    run.steps(60);
    image.steps(60);
    EXPECT_EQ(bits_of(run, false), bits_of(image, true)) << ny;
  }
}

TEST(MixtureFlow, BlocksBoxesAndKindsLeaveNoTrace) {
  const auto start = slab(1000, 1.2, 1e5, {50, 20, 0}, true);
  const auto run_with = [&](const SolverOptions& options, IntVec3 boxes) {
    MixtureBox run(periodic({48, 40, 1}), {water, air}, start, options, boxes);
    run.steps(60);
    return bits_of(run, false);
  };
  expect_same_bits_however_cut(run_with);
}

}  // namespace
}  // namespace sluice::ice::mixture_flow_test
