// Riemann problems of two materials against the exact solution.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/riemann/material_riemann.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::mixture_riemann_test {
namespace {

struct Problem {
  const char* name;
  Fluid left, right;
  double rho_l, u_l, p_l, rho_r, u_r, p_r;
  double x0, t;
  double limit_200, limit_800;  // 1.25 times the prototype's mean |rho - rho_exact|
};

GasBox tube(int n, double length = 1) {
  GasBox box;
  box.cells = {n, 1, 1};
  box.high = {length, 1, 1};
  box.periodic = false;
  box.scheme = "conservative";
  return box;
}

double error_of(const Problem& p, int n) {
  MixtureBox run(tube(n), {p.left, p.right}, [&](Vec3 x) {
    const bool left = x.x < p.x0;
    MixtureCell c;
    c.volume = {left ? 1.0 : 0.0, left ? 0.0 : 1.0};
    c.density = {p.rho_l, p.rho_r};
    c.pressure = {p.p_l, p.p_r};
    c.velocity[0] = left ? p.u_l : p.u_r;
    return c;
  });
  run.run(p.t);
  const exact::MaterialRiemann solution(
      {p.left.law, exact::state_of_pressure(p.left.law, p.rho_l, p.u_l, p.p_l)},
      {p.right.law, exact::state_of_pressure(p.right.law, p.rho_r, p.u_r, p.p_r)});
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    const auto s = solution.sample((x - p.x0) / p.t);
    sum += std::fabs(run.density({i, 0, 0}) - s.state.density) / n;
  }
  EXPECT_EQ(run.rejected(), 0);
  return sum;
}

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8);

const Problem problems[] = {
    {"gases", air, heavy, 1, 0, 1, .125, 0, .1, .5, .2, 1.25 * 2.34e-3, 1.25 * 6.24e-4},
    {"strong", air, heavy, 1, 0, 500, 1, 0, .2, .5, .01, 1.25 * 1.60e-2, 1.25 * 5.35e-3},
    {"water-air 50", water, air, 1000, 0, 1e9, 50, 0, 1e5, .7, 2.4e-4, 1.25 * 2.50, 1.25 * .696},
    {"water-air 1.2", water, air, 1000, 0, 1e9, 1.2, 0, 1e5, .7, 1.2e-4, 1.25 * 1.67, 1.25 * .504},
};

TEST(MixtureRiemann, ErrorsAreThoseOfThePrototype) {
  for (const Problem& p : problems) {
    for (const int n : {200, 800}) {
      const double limit = n == 200 ? p.limit_200 : p.limit_800;
      const double error = error_of(p, n);
      std::printf("%s %d: %.4g (%.3f of prototype)\n", p.name, n, error, 1.25 * error / limit);
      EXPECT_LE(error, limit) << p.name << ", " << n << " cells";
    }
  }
}

}  // namespace
}  // namespace sluice::ice::mixture_riemann_test
