// Viscosity and heat conduction against closed solutions: second order, also across levels; energy
// kept.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "verification/amr_case.hpp"

namespace sluice::verification::diffusion_test {
namespace {

// Measured: bar 2.00, heated Couette 2.00, Poiseuille 2.00, Rayleigh 2.01, heat wave 1.94, on
// levels heat 2.25, shear 1.95.
constexpr double lowest_order = 1.9;
constexpr double allowed_drift = 1e-13;  // of sum |q|
constexpr double straight = 1e-9;        // of a plate's velocity; measured 3e-13
constexpr double pi = std::numbers::pi;

void expect_second_order(const char* what, double coarse, double fine) {
  const double order = std::log2(coarse / fine);
  record(std::string(what) + "_order", order);
  EXPECT_GE(order, lowest_order) << what << ": " << coarse << " " << fine;
}

// Mean |value - exact| along the axis on which the deck has its cells.
double mean_error(const CellValues& q, const std::function<double(double)>& exact) {
  const bool along_y = q.size.y > 1;
  const int n = along_y ? q.size.y : q.size.x;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const Vec3 x = along_y ? q.centre(0, i) : q.centre(i);
    sum += std::fabs((along_y ? q.at(0, i) : q.at(i)) - exact(along_y ? x.y : x.x));
  }
  return sum / n;
}

TEST(Diffusion, BarCoolsAtItsEnd) {
  const auto error = [](int n) {
    const CaseRun run("conduction_bar", {resolution(n)});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(run.worst_drift(), allowed_drift);
    EXPECT_EQ(farthest_from(run.field("vel_CC"), 0), 0);
    const double left = std::exp(-0.1 * pi * pi);  // a (pi/2)^2 t with t = 4
    return mean_error(run.field("temp_CC"),
                      [&](double x) { return 300 + left * std::sin(pi * x / 2); });
  };
  expect_second_order("bar", error(16), error(32));
}

TEST(Diffusion, FrictionHeatsCouetteFlow) {
  const auto error = [](int n) {
    const CaseRun run("couette_heated", {resolution(1, n)});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(run.worst_drift(), allowed_drift);
    EXPECT_LE(mean_error(run.field("vel_CC"), [](double y) { return y; }), straight);
    return mean_error(run.field("temp_CC"), [](double y) { return 2 + y + y * (1 - y); });
  };
  expect_second_order("couette_temperature", error(16), error(32));
}

TEST(Diffusion, PoiseuilleFlowIsAParabola) {
  const auto error = [](int n) {
    const CaseRun run("poiseuille", {resolution(1, n)});
    EXPECT_EQ(run.events(), 0);
    return mean_error(run.field("vel_CC"), [](double y) { return 0.004 * y * (1 - y); });
  };
  expect_second_order("poiseuille", error(8), error(16));
}

TEST(Diffusion, SuddenPlateDragsTheGasAlong) {
  const auto error = [](int n) {
    const CaseRun run("rayleigh", {resolution(1, n)});
    EXPECT_EQ(run.events(), 0);
    return mean_error(run.field("vel_CC"),
                      [](double y) { return 0.001 * std::erfc(y / (2 * std::sqrt(0.02 * 0.5))); });
  };
  expect_second_order("rayleigh", error(32), error(64));
}

// Amplitudes of density, velocity and temperature of the linear wave in the deck, by Runge-Kutta.
std::array<double, 3> linear_wave(double time) {
  constexpr double k = 2 * pi, gamma = 1.4, a = 0.05, R = 0.4, T0 = 2.5;
  using State = std::array<double, 3>;
  const auto rate = [](const State& s) {
    return State{k * s[1], -k * R * (T0 * s[0] + s[2]),
                 (gamma - 1) * T0 * k * s[1] - a * k * k * s[2]};
  };
  const auto moved = [](const State& s, const State& by, double h) {
    return State{s[0] + h * by[0], s[1] + h * by[1], s[2] + h * by[2]};
  };
  constexpr int steps = 4000;
  const double h = time / steps;
  State s{0, 0, 0.00025};
  for (int n = 0; n < steps; ++n) {
    const State a1 = rate(s), a2 = rate(moved(s, a1, h / 2)), a3 = rate(moved(s, a2, h / 2)),
                a4 = rate(moved(s, a3, h));
    for (std::size_t q = 0; q < 3; ++q) s[q] += h / 6 * (a1[q] + 2 * a2[q] + 2 * a3[q] + a4[q]);
  }
  return s;
}

// Nothing but round-off in a closed box with shocks, friction and conduction.
TEST(Diffusion, KeepsWhatAClosedBoxHolds) {
  const CaseRun run("blast_2d",
                    {resolution(64, 64), "MaterialProperties/ICE/material/dynamic_viscosity=0.002",
                     "MaterialProperties/ICE/material/thermal_conductivity=0.004"});
  EXPECT_LE(run.worst_drift(), allowed_drift);
  EXPECT_GT(lowest(run.field("press_CC")), 0);
  record("box_drift", run.worst_drift());
}

TEST(Diffusion, HeatWaveInAGasFollowsLinearTheory) {
  constexpr double near = 0.004;  // of each amplitude, 64 cells; measured 0.0015, 0.0020, 0.0009
  const std::array<double, 3> wave = linear_wave(0.5);
  const auto error = [&](int n) {
    const CaseRun run("heat_wave", {resolution(n), "CFD/cfl=0.1"});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(run.worst_drift(), allowed_drift);
    const auto of = [&](const char* variable, std::size_t q, double mean, bool cosine) {
      const double shift = cosine ? pi / 2 : 0;
      return mean_error(run.field(variable),
                        [&](double x) { return mean + wave[q] * std::sin(2 * pi * x + shift); }) /
             std::fabs(wave[q]);
    };
    if (n == 64) {
      EXPECT_LE(of("rho_CC", 0, 1, false), near);
      EXPECT_LE(of("vel_CC", 1, 0, true), near);
      EXPECT_LE(of("temp_CC", 2, 2.5, false), near);
    }
    return of("temp_CC", 2, 2.5, false);
  };
  expect_second_order("heat_wave", error(32), error(64));
}

// Mean error over the cells that no finer level covers.
double error_on_levels(const CaseRun& run, const char* variable, int component,
                       const std::function<double(double)>& exact) {
  double sum = 0, volume = 0;
  for (const LevelCell& c : level_cells(run, variable, component)) {
    if (c.covered) continue;
    sum += c.volume * std::fabs(c.value - exact(c.centre.x));
    volume += c.volume;
  }
  return sum / volume;
}

TEST(Diffusion, GoesOnAcrossLevels) {
  const double left = std::exp(-0.02 * 4 * pi * pi);
  std::array<double, 2> heat, shear;
  for (std::size_t n = 0; n < 2; ++n) {
    const int cells = n == 0 ? 64 : 128;
    const CaseRun run("amr_diffusion", {level_resolution(1, cells), level_resolution(2, cells)});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(run.worst_drift(), allowed_drift);
    heat[n] = error_on_levels(run, "temp_CC", 0,
                              [&](double x) { return 300 + left * std::sin(2 * pi * x); });
    shear[n] = error_on_levels(run, "vel_CC", 1,
                               [&](double x) { return 0.01 * left * std::cos(2 * pi * x); });
  }
  expect_second_order("levels_heat", heat[0], heat[1]);
  expect_second_order("levels_shear", shear[0], shear[1]);
}

}  // namespace
}  // namespace sluice::verification::diffusion_test
