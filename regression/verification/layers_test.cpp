// Friction and conduction with two materials in layers: exact solutions, energy, levels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>

#include "verification/amr_case.hpp"

namespace sluice::verification::layers_test {
namespace {

constexpr double lowest_order = 1.9;
constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps
constexpr double straight = 1e-9;        // of the plate's velocity
constexpr double pi = std::numbers::pi;

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}

// Velocity between plates 1 apart, the interface at .25; the upper plate's is .01.
double layered_couette(double y, double mu_below, double mu_above) {
  const double stress = .01 / (.25 / mu_below + .75 / mu_above);
  return y < .25 ? stress * y / mu_below : .01 - stress * (1 - y) / mu_above;
}

TEST(Layers, CouetteFlowHasOneStress) {
  const CaseRun run("layers_couette");
  const CellValues u = run.field("vel_CC");
  double worst = 0;
  for (int j = 0; j < u.size.y; ++j)
    worst =
        std::fmax(worst, std::fabs(u.at(0, j) - layered_couette(u.centre(0, j).y, .2, .05)) / .01);
  record("velocity", worst);
  EXPECT_LE(worst, straight);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_EQ(run.events(), 0);
}

// Couette flow with Sutherland's law in two layers: velocity and temperature at `y`, for one stress
// and one heat flux at y = 0, by the midpoint rule.
struct Profile {
  double u = 0, T = .1;
};
Profile follow(double stress, double heat, double y) {
  constexpr int steps = 4000;
  Profile p;
  double flux = heat;  // k T'
  const double h = 1. / steps;
  const auto slope = [&](double x, Profile at) {
    const double a = x < .25 ? 1 : .3, b = x < .25 ? .1 : .2;
    return stress / (a * std::sqrt(at.T) / (1 + b / at.T));
  };
  const auto k = [](double x) { return x < .25 ? .05 : .1; };
  for (int n = 0; n * h < y - 1e-12; ++n) {
    const double x = (n + .5) * h;
    const Profile middle{0, p.T + .5 * h * flux / k(x)};
    const double du = slope(x, middle);
    p.u += h * du;
    p.T += h * (flux - .5 * h * stress * du) / k(x);
    flux -= h * stress * du;
  }
  return p;
}
// Newton's method for the state of the plate at y = 1.
std::array<double, 2> shoot() {
  double s = .005, q = .008;
  for (int n = 0; n < 20; ++n) {
    constexpr double d = 1e-7;
    const Profile p = follow(s, q, 1), ps = follow(s + d, q, 1), pq = follow(s, q + d, 1);
    const double us = (ps.u - p.u) / d, uq = (pq.u - p.u) / d;
    const double ts = (ps.T - p.T) / d, tq = (pq.T - p.T) / d;
    const double ru = .1 - p.u, rt = .2 - p.T, det = us * tq - uq * ts;
    s += (ru * tq - uq * rt) / det;
    q += (us * rt - ru * ts) / det;
  }
  return {s, q};
}

TEST(Layers, SutherlandsLawIsThatOfEachLayer) {
  const auto [stress, heat] = shoot();
  EXPECT_NEAR(follow(stress, heat, 1).u, .1, 1e-12);
  const auto errors = [&, s = stress, q = heat](int n) {
    const CaseRun run("layers_sutherland", {resolution(1, n)});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(drift_per_thousand(run), allowed_drift);
    const CellValues u = run.field("vel_CC"), below = run.field("temp_CC", 0, "last", 0),
                     above = run.field("temp_CC", 0, "last", 1);
    std::array<double, 2> sum{};
    for (int j = 0; j < n; ++j) {
      const double y = u.centre(0, j).y;
      const Profile exact = follow(s, q, y);
      sum[0] += std::fabs(u.at(0, j) - exact.u) / n;
      sum[1] += std::fabs((y < .25 ? below : above).at(0, j) - exact.T) / n;
    }
    record("velocity_" + std::to_string(n), sum[0]);
    record("temperature_" + std::to_string(n), sum[1]);
    return sum;
  };
  const auto coarse = errors(8), fine = errors(16);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_GE(std::log2(coarse[k] / fine[k]), lowest_order) << coarse[k] << " " << fine[k];
}

// A gas that slips along a layer which takes the place of a solid: layers in series.
TEST(Layers, GasSlipsAlongALayer) {
  constexpr double allowed = 1e-4;  // of the differences between the plates
  const CaseRun run("layers_slip");
  EXPECT_EQ(run.events(), 0);
  const double h = std::sqrt(2 / pi) / 3;
  const double stress = 1e-5 / (.25 / .2 + 1 / h + .75 / .05);
  const double heat = 1e-6 / (.25 / .2 + 1 / (1.2 * h) + .75 / .05);
  const CellValues u = run.field("vel_CC"), wall = run.field("temp_CC", 0, "last", 0),
                   gas = run.field("temp_CC", 0, "last", 1);
  double velocity = 0, temperature = 0;
  for (int j = 0; j < u.size.y; ++j) {
    const double y = u.centre(0, j).y;
    const double exact = y < .25 ? stress * y / .2 : 1e-5 - stress * (1 - y) / .05;
    const double T = y < .25 ? 2.5 + heat * y / .2 : 2.500001 - heat * (1 - y) / .05;
    velocity = std::fmax(velocity, std::fabs(u.at(0, j) - exact) / 1e-5);
    temperature = std::fmax(temperature, std::fabs((y < .25 ? wall : gas).at(0, j) - T) / 1e-6);
  }
  record("velocity", velocity);
  record("temperature", temperature);
  EXPECT_LE(velocity, allowed);
  EXPECT_LE(temperature, allowed);
}

// The same where each has a velocity of its own, on a grid whose faces (n = 16) or centres (n = 10,
// 30) the surface lies on: error by the plate's velocity, and how the step of the velocity inside
// the cell of the surface compares with the exact one.
struct Slipping {
  double error = 0, step = 1;
};
Slipping slip_by_itself(int n, double accommodation) {
  const std::string exchange = "MaterialProperties/exchange_properties/";
  const CaseRun run(
      "layers_slip",
      {resolution(1, n), "Time/maxTime=100", exchange + "exchange_coefficients/momentum=[9e9]",
       exchange + "Model/momentum_accommodation_coeff=" + std::to_string(accommodation)});
  EXPECT_EQ(run.events(), 0);
  const double h = std::sqrt(2 / pi) * accommodation / (2 - accommodation);
  const double stress = 1e-5 / (.25 / .2 + 1 / h + .75 / .05);
  const CellValues wall = run.field("vel_CC", 0, "last", 0),
                   gas = run.field("vel_CC", 0, "last", 1);
  Slipping result;
  for (int j = 0; j < n; ++j) {
    const double y = gas.centre(0, j).y;
    if (std::fabs(y - .25) < .1 / n) {
      result.step = (gas.at(0, j) - wall.at(0, j)) / (stress / h);
      continue;
    }
    const double exact = y < .25 ? stress * y / .2 : 1e-5 - stress * (1 - y) / .05;
    const double found = (y < .25 ? wall : gas).at(0, j);
    result.error = std::fmax(result.error, std::fabs(found - exact) / 1e-5);
  }
  return result;
}

constexpr double slip_on_a_face = 1e-4;  // measured 1.9e-5

void expect_slip(std::initializer_list<double> accommodations) {
  constexpr double in_a_cell = .02;     // measured .019
  constexpr double of_the_step = .025;  // .0233
  constexpr double first_order = .95;   // .957
  for (const double a : accommodations) {
    const double sharp = slip_by_itself(16, a).error;
    record("sharp", sharp);
    EXPECT_LE(sharp, slip_on_a_face) << a;
    const Slipping coarse = slip_by_itself(10, a), fine = slip_by_itself(30, a);
    std::printf("a %g: on a face %.1e, in a cell %.1e %.1e, step %.4f %.4f\n", a, sharp,
                coarse.error, fine.error, coarse.step, fine.step);
    EXPECT_LE(fine.error, in_a_cell) << a;
    EXPECT_NEAR(fine.step, 1, of_the_step) << a;
    if (a < .1) continue;  // neither has a stress
    const double order = std::log((1 - coarse.step) / (1 - fine.step)) / std::log(3.);
    record("order", order);
    EXPECT_GE(order, first_order) << a;
  }
}

// Maxwell's slip of half of the molecules; next to none, and of all.
TEST(FullLayers, GasWithAVelocityOfItsOwnSlips) {
  expect_slip({.5, 1e-6, 1.});
}
TEST(Layers, GasWithAVelocityOfItsOwnSlipsWhereTheSurfaceIsOnAFace) {
  EXPECT_LE(slip_by_itself(16, .5).error, slip_on_a_face);
}

// An interface inside a cell: the mean viscosity of the cell is not that of two layers in series.
void expect_first_order(int coarse_cells, int fine_cells) {
  constexpr double first_order = 0.95;
  const auto error = [](int n) {
    const CaseRun run("layers_couette", {resolution(1, n)});
    const CellValues u = run.field("vel_CC");
    double sum = 0;
    for (int j = 0; j < n; ++j)
      sum += std::fabs(u.at(0, j) - layered_couette(u.centre(0, j).y, .2, .05)) / .01;
    return sum / n;
  };
  const double coarse = error(coarse_cells), fine = error(fine_cells);
  const double order =
      std::log(coarse / fine) / std::log(static_cast<double>(fine_cells) / coarse_cells);
  record("coarse", coarse);
  record("order", order);
  EXPECT_GE(order, first_order);
}
TEST(Layers, AnInterfaceInsideACellIsOfFirstOrder) {
  expect_first_order(6, 18);
}
TEST(FullLayers, AnInterfaceInsideACellIsOfFirstOrder) {
  expect_first_order(10, 30);
}

// An inviscid fluid slides along a viscous one: at rest below, dragged along above.
TEST(Layers, AnInviscidLayerSlides) {
  const CaseRun run("layers_couette",
                    {"MaterialProperties/ICE/material[1]/dynamic_viscosity=0", "Time/maxTime=120"});
  const CellValues u = run.field("vel_CC");
  for (int j = 0; j < u.size.y; ++j)
    EXPECT_NEAR(u.at(0, j) / .01, u.centre(0, j).y < .25 ? 0.0 : 1.0, straight) << j;
}

double mean_error(const CaseRun& run, double decay) {
  double sum = 0;
  int cells = 0;
  for (int m = 0; m < 2; ++m) {
    const CellValues T = run.field("temp_CC", 0, "last", m);
    const CellValues share = run.field("vol_frac_CC", 0, "last", m);
    for (int i = 0; i < T.size.x; ++i) {
      if (!(share.at(i) > .5)) continue;
      const double x = T.centre(i).x;
      const double exact = x < 4 ? std::sin(pi * x / 16) : std::sin(pi * (7 - x) / 4);
      sum += std::fabs(T.at(i) - 300 - decay * exact);
      ++cells;
    }
  }
  EXPECT_EQ(cells, run.field("vel_CC").size.x);
  return sum / cells;
}

TEST(Layers, HeatPassesFromOneToTheOther) {
  const double decay = std::exp(-pi * pi / 64 * 4);
  const auto error = [&](int n) {
    const CaseRun run("layers_bar", {resolution(n)});
    EXPECT_EQ(run.events(), 0);
    EXPECT_LE(drift_per_thousand(run), allowed_drift);
    EXPECT_EQ(farthest_from(run.field("vel_CC"), 0), 0);
    return mean_error(run, decay);
  };
  const double coarse = error(28), fine = error(56);
  record("order", std::log2(coarse / fine));
  EXPECT_GE(std::log2(coarse / fine), lowest_order) << coarse << " " << fine;
}

// A region around the interface; one that ends there, one that begins there: next to interfaces
// fine ghost cells hold what the coarse cell does, which is of first order.
void expect_heat_to_pass(std::initializer_list<const char*> lows) {
  constexpr double lowest_at_interface = 0.8;  // measured 0.90, 0.87
  const double decay = std::exp(-pi * pi / 64 * 4);
  for (const char* low : lows) {
    const double lowest = std::string(low) == "3" ? lowest_order : lowest_at_interface;
    const auto error = [&](int n) {
      const std::string box = "Grid/Level[2]/Box/", from = low;
      const std::string to = from == "2" ? "4" : from == "4" ? "6" : "5";
      const CaseRun run("amr_layers_bar",
                        {level_resolution(1, n), level_resolution(2, 4 * n / 7),
                         box + "lower=[" + from + ",0,0]", box + "upper=[" + to + ",0.25,0.25]"});
      EXPECT_EQ(run.events(), 0);
      EXPECT_LE(drift_per_thousand(run), allowed_drift);
      double sum = 0, length = 0;
      for (int m = 0; m < 2; ++m) {
        const auto share = level_cells(run, "vol_frac_CC", 0, "last", m);
        const auto T = level_cells(run, "temp_CC", 0, "last", m);
        for (std::size_t i = 0; i < T.size(); ++i) {
          if (T[i].covered || !(share[i].value > .5)) continue;
          const double x = T[i].centre.x;
          const double exact = x < 4 ? std::sin(pi * x / 16) : std::sin(pi * (7 - x) / 4);
          sum += T[i].volume * std::fabs(T[i].value - 300 - decay * exact);
          length += T[i].volume;
        }
      }
      return sum / length;
    };
    const double coarse = error(28), fine = error(56);
    record(std::string("order_from_") + low, std::log2(coarse / fine));
    record(std::string("error_from_") + low, fine);
    EXPECT_GE(std::log2(coarse / fine), lowest) << low << ": " << coarse << " " << fine;
  }
}
TEST(Layers, HeatPassesFromLevelToLevel) {
  expect_heat_to_pass({"3"});
}
TEST(FullLayers, HeatPassesFromLevelToLevelAtTheInterface) {
  expect_heat_to_pass({"2", "4"});
}

// Without heat exchange the interface insulates: each layer keeps its heat but for its own end.
TEST(Layers, WithoutHeatExchangeTheInterfaceInsulates) {
  const CaseRun run("layers_bar",
                    {"MaterialProperties/exchange_properties/exchange_coefficients/heat=[0]",
                     "MaterialProperties/ICE/material[1]/thermal_conductivity=0"});
  const CellValues T = run.field("temp_CC", 0, "last", 0),
                   before = run.field("temp_CC", 0, "first");
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(T.at(i), before.at(i), 1e-12) << i;
  EXPECT_LE(run.worst_drift(), allowed_drift);
}

// Water in a shocked gas on levels that follow it: friction, conduction and heat exchange across
// faces where levels and materials meet.
TEST(FullLayers, LevelsKeepWhatRubsAndConducts) {
  const std::string material = "MaterialProperties/ICE/material";
  const CaseRun run(
      "amr_water_cylinder",
      {"MaterialProperties/exchange_properties/exchange_coefficients/heat=[1e8]",
       material + "[1]/dynamic_viscosity=2", material + "[1]/thermal_conductivity=6e3",
       material + "[2]/dynamic_viscosity=0.1", material + "[2]/thermal_conductivity=200"});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  ASSERT_GE(max_cells(run).size(), 2u);
  EXPECT_GT(regrids(run), 0);
  EXPECT_GT(lowest(run.field("press_CC")), 0);
}

}  // namespace
}  // namespace sluice::verification::layers_test
