// Means over cells against closed forms and against sums over very many points.
#include "exact/base/cell_mean.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "exact/base/adaptive_mean.hpp"
#include "exact/exact_solutions.hpp"
#include "exact/riemann/riemann.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::cell_mean_test {
namespace {

constexpr std::array<bool, 3> along_x = {true, false, false}, plane = {true, true, false};

std::unique_ptr<ExactSolution> riemann(const std::string& left, const std::string& right) {
  return make_exact_solution({"riemann", {{"left", left}, {"right", right}, {"position", "0.5"}}});
}

TEST(AdaptiveMean, OfPolynomialsToDegreeNineTakesSevenPoints) {
  int points = 0;
  const auto f = [&](double x) {
    ++points;
    return std::array<double, 2>{std::pow(x, 9) + x, std::pow(x, 8)};
  };
  const auto mean = adaptive_mean<2>(f, -1, 3, [](const auto&) { return false; });
  EXPECT_NEAR(mean[0], (std::pow(3.0, 10) - 1) / 40 + 1, 1e-11 * 1476);
  EXPECT_NEAR(mean[1], (std::pow(3.0, 9) + 1) / 36, 1e-11 * 547);
  EXPECT_EQ(points, 7);
}

TEST(AdaptiveMean, FindsAJumpAnywhere) {
  for (const double jump : {1e-7, 0.01, 0.3, 0.5, 0.77, 0.999999}) {
    const auto f = [&](double x) { return std::array<double, 1>{x < jump ? 3.0 : 1.0}; };
    const auto mean =
        adaptive_mean<1>(f, 0, 1, [](const auto& d) { return std::abs(d[0]) > 1e-10; });
    EXPECT_NEAR(mean[0], 1 + 2 * jump, 1e-8) << jump;
  }
}

// Means against those by brute force: the norm of an error that a run could have, and the largest
// difference.
struct Compared {
  double tolerance;  // of the means
  double worst = 0, sum = 0, error = 0;
  void add(double mean, double brute, double computed) {
    worst = std::max(worst, std::abs(mean - brute));
    sum += std::abs(computed - brute);
    error += std::abs(computed - mean);
  }
  void check() const {
    EXPECT_NEAR(error / sum, 1, 1e-4);
    EXPECT_LE(worst, 10 * tolerance);
  }
};

// Mean of what is smooth from a to b: Gauss's rule with 3 points in each of 64 panels.
double gauss_mean(const std::function<double(double)>& f, double a, double b) {
  const double place = std::sqrt(0.6);
  constexpr int panels = 64;
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double m = a + (k + 0.5) * (b - a) / panels, h = 0.5 * (b - a) / panels;
    sum += (5 * f(m - place * h) + 8 * f(m) + 5 * f(m + place * h)) / 18 / panels;
  }
  return sum;
}

// Densities of a Riemann problem in 100 cells of the unit interval against integrals between its
// waves, whose speeds the solution tells.
void compare_tube(GasState left, GasState right, double t) {
  const RiemannSolution solution(left, right);
  const auto text = [](GasState s) {
    return fmt::format("[{},{},{}]", s.density, s.velocity, s.pressure);
  };
  const auto exact = riemann(text(left), text(right));
  const CellMean mean(*exact, t, {"rho_CC"});
  const auto rho = [&](double x) { return solution.sample((x - 0.5) / t).density; };
  Compared both{2e-7};
  for (int i = 0; i < 100; ++i) {
    const double a = i / 100.0, b = (i + 1) / 100.0;
    std::vector<double> edges = {a, b};
    const auto l = solution.left_wave(), r = solution.right_wave();
    for (const double speed : {l.head, l.tail, solution.star_velocity(), r.head, r.tail})
      if (const double x = 0.5 + speed * t; x > a && x < b) edges.push_back(x);
    std::sort(edges.begin(), edges.end());
    double brute = 0;
    for (std::size_t e = 0; e + 1 < edges.size(); ++e)
      brute += gauss_mean(rho, edges[e], edges[e + 1]) * (edges[e + 1] - edges[e]) / (b - a);
    both.add(mean.over({a, 0, 0}, {b, 1, 1}, along_x, both.tolerance), brute,
             brute * (1 + 0.01 * std::sin(7.0 * i)));
  }
  both.check();
}

TEST(CellMeans, OfRiemannProblemsHoldTheWavesInsideACell) {
  compare_tube({1, 0, 1}, {0.125, 0, 0.1}, 0.2);                    // Sod
  compare_tube({1, -19.59745, 1000}, {1, -19.59745, 0.01}, 0.012);  // slow contact
  compare_tube({1, -2, 0.4}, {1, 2, 0.4}, 0.15);                    // 123
}

TEST(CellMeans, OfConservedAmountsGiveVelocityAndPressure) {
  // Contact in the middle of the cell: momentum is shared by mass, pressure stays; a shock keeps
  // part of the energy as motion inside the cell.
  const auto contact = riemann("[4,1,2]", "[1,1,2]");
  const Vec3 low{0.4, 0, 0}, high{0.6, 1, 1};
  const auto value = [&](const ExactSolution& s, const std::string& name) {
    return CellMean(s, 0, {name, 0, 0, 2.5}).over(low, high, along_x, 1e-10);
  };
  EXPECT_NEAR(value(*contact, "rho_CC"), 2.5, 1e-9);
  EXPECT_NEAR(value(*contact, "sp_vol_CC"), 0.4, 1e-9);
  EXPECT_NEAR(value(*contact, "vel_CC"), 1, 1e-9);
  EXPECT_NEAR(value(*contact, "press_CC"), 2, 1e-9);
  EXPECT_NEAR(value(*contact, "temp_CC"), 2 / 0.4 / 2.5 / 2.5, 1e-9);
  const auto meeting = riemann("[3,1,2]", "[1,-1,2]");
  EXPECT_NEAR(value(*meeting, "vel_CC"), 0.5, 1e-9);
  // <m^2/2 rho> = 1, <m>^2/(2 <rho>) = 1/4.
  EXPECT_NEAR(value(*meeting, "press_CC"), 2 + 0.4 * 0.75, 1e-9);
  EXPECT_THROW(CellMean(*contact, 0, {"delP_Dilatate"}), InputError);
}

// Density, momentum and energy of a cell, by m x m midpoints.
std::array<double, 4> midpoint_sums(const ExactSolution& flow, double t, Vec3 low, double h,
                                    int m) {
  std::array<double, 4> sum{};
  for (int p = 0; p < m * m; ++p) {
    const State s = flow.at(low + Vec3{h * (p % m + 0.5) / m, h * (p / m + 0.5) / m, 0}, t);
    const double w = 1.0 / (m * m);
    sum[0] += w * s.density, sum[1] += w * s.density * s.velocity.x;
    sum[2] += w * s.density * s.velocity.y;
    sum[3] += w * (s.pressure / (s.gamma - 1) + 0.5 * s.density * dot(s.velocity, s.velocity));
  }
  return sum;
}

TEST(CellMeans, OfTheVortexAgreeWithManyPoints) {
  const auto vortex = make_exact_solution({"isentropic_vortex", {{"period", "16"}}});
  constexpr int n = 12;
  Compared density{1e-8}, velocity{1e-8}, pressure{1e-8};
  for (int k = 0; k < n * n; ++k) {
    const Vec3 low{-3 + 0.5 * (k % n), -3 + 0.5 * (k / n), 0}, high = low + Vec3{0.5, 0.5, 1};
    const auto coarse = midpoint_sums(*vortex, 0, low, 0.5, 16);
    auto q = midpoint_sums(*vortex, 0, low, 0.5, 32);
    for (int j = 0; j < 4; ++j) q[j] += (q[j] - coarse[j]) / 3;  // Richardson: fourth order
    const auto add = [&](Compared& both, const char* name, double brute) {
      const CellMean mean(*vortex, 0, {name});
      both.add(mean.over(low, high, plane, both.tolerance), brute, brute + 1e-3 * std::sin(k));
    };
    add(density, "rho_CC", q[0]);
    add(velocity, "vel_CC", q[1] / q[0]);
    add(pressure, "press_CC", 0.4 * (q[3] - (q[1] * q[1] + q[2] * q[2]) / (2 * q[0])));
  }
  density.check(), velocity.check(), pressure.check();
}

// Cylindrical Noh problem: its front cuts cells, and the gas ahead varies; against many midpoints.
TEST(CellMeans, OfACylindricalShockAgreeWithManyPoints) {
  const auto noh = make_exact_solution({"noh", {{"dimension", "2"}}});
  const double t = 1, h = 0.05;
  Compared both{1e-5};
  const CellMean mean(*noh, t, {"rho_CC"});
  for (int k = 0; k < 10; ++k) {  // along the diagonal; the front is at a third
    const Vec3 low{h * k, h * k, 0}, high = low + Vec3{h, h, 1};
    const double brute = midpoint_sums(*noh, t, low, h, k == 4 ? 2048 : 128)[0];
    both.add(mean.over(low, high, plane, both.tolerance), brute, brute + 0.1 * std::sin(k + 1));
  }
  both.check();
}

// A cylinder of dense gas cut by cells: area of the circle in each, by its closed form.
TEST(CellMeans, OfACircleAreItsAreaInEachCell) {
  const auto disk = make_exact_solution({"radial",
                                         {{"dimension", "2"},
                                          {"high", "1"},
                                          {"states", "[1,0,1,0.125,0,0.1]"},
                                          {"edges", "[0.4]"},
                                          {"cells", "4000"}}});
  constexpr int n = 20;
  constexpr double r = 0.4, h = 1.0 / n;
  const CellMean mean(*disk, 0, {"rho_CC"});
  // Integral of sqrt(r^2 - x^2).
  const auto under = [&](double x) {
    return 0.5 * (x * std::sqrt(r * r - x * x) + r * r * std::asin(x / r));
  };
  // Area of the disk right of x = a to b, above 0 and below y, in the first quadrant.
  const auto area = [&](double a, double b, double y) {
    if (a >= r || y <= 0) return 0.0;
    b = std::min(b, r);
    const double corner = y < r ? std::sqrt(r * r - y * y) : 0;  // circle above y left of it
    const double flat = std::clamp(corner, a, b);
    return (flat - a) * y + under(b) - under(flat);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = i * h, y = j * h;
      const double inside = (area(x, x + h, y + h) - area(x, x + h, y)) / (h * h);
      EXPECT_NEAR(mean.over({x, y, 0}, {x + h, y + h, 1}, plane, 1e-6), 0.125 + 0.875 * inside,
                  // The reference solver is linear between centres of cells 1/4000 apart.
                  2e-3 * (inside > 0 && inside < 1) + 1e-4)
          << i << " " << j;
    }
}

TEST(CellMeans, OfSeveralMaterialsAreOfTheMixture) {
  const auto tube = make_exact_solution({"two_materials",
                                         {{"left", "[1000, 0, 1e9]"},
                                          {"eos_left", "StiffenedGas gamma=4.4 pinf=6e8"},
                                          {"right", "[50, 0, 1e5]"},
                                          {"eos_right", "ideal_gas gamma=1.4"},
                                          {"position", "0.25"}}});
  const auto value = [&](const char* name, int material) {
    return CellMean(*tube, 0, {name, 0, material}).over({0, 0, 0}, {1, 1, 1}, along_x, 1e-9);
  };
  EXPECT_NEAR(value("rho_CC", 0), 250 + 37.5, 1e-6);
  EXPECT_NEAR(value("vol_frac_CC", 0), 0.25, 1e-8);
  EXPECT_NEAR(value("vol_frac_CC", 1), 0.75, 1e-8);
  EXPECT_NEAR(value("press_CC", 0) / 250075000, 1, 1e-9);
}

}  // namespace
}  // namespace sluice::exact::cell_mean_test
