// Semi-implicit steps as short as explicit ones against those; sound at any length of the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/case_run.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::implicit_waves_test {
namespace {

constexpr double allowed_ratio = 1.3;  // of an explicit error, Courant number 1/2

struct Against {
  const char* deck;
  int cells;
  double time;  // 0: the deck's
};
// Behind each row what was measured: ratio after one pass, and with passes to 1e-4.
const Against shocks[] = {
    {"riemann_sod", 200, 0},           // 1.183  1.144
    {"riemann_123", 200, 0},           // 1.168  1.143
    {"riemann_left_blast", 200, 0},    // 0.929  0.930
    {"riemann_right_blast", 200, 0},   // 0.937  0.938
    {"riemann_two_shocks", 200, 0},    // 0.979  0.979
    {"riemann_slow_contact", 200, 0},  // 0.847  0.844
};

class ImplicitShocks : public testing::TestWithParam<Against> {};

TEST_P(ImplicitShocks, AreNoWorseThanExplicitOnes) {
  const Against& a = GetParam();
  const Overrides half{"CFD/cfl=0.5", resolution(a.cells)};
  const double reference = CaseRun(a.deck, half).error("rho_CC").l1;
  for (const Overrides& passes : {solved(1), solved(20, 1e-4)}) {
    const CaseRun run(a.deck, half + passes);
    const double ratio = run.error("rho_CC").l1 / reference;
    record(passes[0], ratio);
    EXPECT_LE(ratio, allowed_ratio);
    EXPECT_EQ(run.events(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Six, ImplicitShocks, testing::ValuesIn(shocks),
                         [](const auto& test) { return std::string(test.param.deck).substr(8); });

double vortex_ratio(int n, double time) {
  const Overrides half = Overrides{"CFD/cfl=0.5", resolution(n, n)} + until(time);
  const double ratio = CaseRun("vortex", half + solved()).error("rho_CC").l1 /
                       CaseRun("vortex", half).error("rho_CC").l1;
  record("vortex", ratio);
  return ratio;
}

TEST(ImplicitVortex, IsNoWorseThanTheExplicitOne) {
  EXPECT_LE(vortex_ratio(32, 4), allowed_ratio);  // measured 0.998
}

TEST(FullImplicitVortex, IsNoWorseThanTheExplicitOne) {
  EXPECT_LE(vortex_ratio(64, 4), allowed_ratio);  // measured 0.997
}

// Mean |rho - exact| over the amplitude after one period; Courant number C.
double sound_error(int n, double C) {
  const CaseRun run("sound_wave", steps_of(C / n, static_cast<int>(std::lround(n / C))) +
                                      solved(1, 1e-6, 1e-10) + Overrides{resolution(n)});
  const CellValues rho = run.field("rho_CC");
  double sum = 0;
  for (int i = 0; i < n; ++i)
    sum += std::fabs(rho.at(i) - 1 - 1e-6 * std::cos(2 * std::numbers::pi * rho.centre(i).x));
  return sum / n / 1e-6;
}

TEST(ImplicitSound, IsNoWorseThanExplicitSound) {
  // Explicit at Courant number 1/2: 1.55e-2, 3.51e-3 on 32, 64 cells. Measured 1.58e-3, 1.99e-4.
  EXPECT_LE(sound_error(32, 0.5), 1.55e-2);
  EXPECT_LE(sound_error(64, 0.5), 3.51e-3);
}

TEST(ImplicitSound, IsOfSecondOrderInTime) {
  constexpr double lowest_order = 1.9;  // measured 2.02, from 32 to 64 steps a period
  const double coarse = sound_error(128, 4), fine = sound_error(128, 2);
  record("order", std::log2(coarse / fine));
  EXPECT_GE(std::log2(coarse / fine), lowest_order) << coarse << " " << fine;
}

// The pulse with noise: energy of the disturbance and checkerboard in units of the pulse's height.
struct Disturbance {
  double energy, checkerboard;
};
Disturbance disturbance(const CaseRun& run, const std::string& when) {
  constexpr double height = 1e-3;
  const CellValues p = run.field("press_CC", 0, when), u = run.field("vel_CC", 0, when);
  Disturbance d{0, 0};
  const int n = p.size.x;
  for (int i = 0; i < n; ++i) {
    const double rise = p.at(i) - 1;
    d.energy += rise * rise / 2.8 + 0.7 * u.at(i) * u.at(i);  // rho 1.4, rho c^2 1.4
    if (i > 0) d.checkerboard += (i % 2 == 0 ? 1 : -1) * (p.at(i) - p.at(i - 1));
  }
  d.checkerboard = std::fabs(d.checkerboard) / (2 * (n - 1)) / height;
  return d;
}

void expect_no_growth(const Overrides& more, int outputs) {
  constexpr double allowed_checkerboard = 0.02;  // measured at most 1.3e-4
  const CaseRun run("implicit_pulse", more);
  const double start = disturbance(run, "first").energy;
  for (int n = 1; n <= outputs; ++n) {
    const Disturbance now = disturbance(run, "#" + std::to_string(n));
    EXPECT_LE(now.energy, start) << n;
    if (n == outputs) {
      record("checkerboard", now.checkerboard);
      record("energy", now.energy / start);
      EXPECT_LE(now.checkerboard, allowed_checkerboard);
    }
  }
  EXPECT_EQ(run.events(), 0);
}

const Overrides periodic{"Grid/Level/periodic=[1,1,1]", "Grid/Level/Box/extraCells=[0,0,0]"};

class ImplicitPulse : public testing::TestWithParam<double> {};

TEST_P(ImplicitPulse, WithNoiseNeverGrows) {
  const double dt = GetParam() / 64;
  expect_no_growth(steps_of(dt, 200, 10), 10);
  expect_no_growth(steps_of(dt, 200, 10) + periodic, 10);
}

TEST_P(ImplicitPulse, FullNeverGrowsInFiveThousandSteps) {
  const double dt = GetParam() / 64;
  expect_no_growth(steps_of(dt, 5000, 100), 100);
  expect_no_growth(steps_of(dt, 5000, 100) + periodic, 100);
}

// Steps that end at outputs: of 1, 1, .37 and of 1, .1 times the longest.
TEST_P(ImplicitPulse, NeverGrowsWhenStepsChange) {
  const double dt = GetParam() / 64;
  for (const double every : {2.37, 1.1}) {
    constexpr int outputs = 20;
    Overrides more = steps_of(dt, 100, 10) + Overrides{"Time/clamp_time_to_output=true"};
    more.push_back(fmt::format("Time/maxTime={:.17g}", every * dt * outputs));
    more.push_back(fmt::format("DataArchiver/outputInterval={:.17g}", every * dt));
    expect_no_growth(more, outputs);
  }
  // No step like another, down to a tenth and less: between the teeth of two combs whose widths
  // have an irrational ratio.
  constexpr int outputs = 50;
  Overrides more = steps_of(dt, 100, 100) + Overrides{"Time/clamp_time_to_output=true"};
  more.push_back(fmt::format("Time/maxTime={:.17g}", std::numbers::phi * dt * outputs));
  more.push_back(fmt::format("DataArchiver/outputInterval={:.17g}", std::numbers::phi * dt));
  more.push_back(fmt::format("DataArchiver/checkpoint/@interval={:.17g}", 1.1 * dt));
  expect_no_growth(more, outputs);
}

const auto name_of_number = [](const auto& test) {
  return test.param < 1 ? std::string("half") : std::to_string(static_cast<int>(test.param));
};
INSTANTIATE_TEST_SUITE_P(CellsOfSound, ImplicitPulse, testing::Values(0.5, 20, 500),
                         name_of_number);
INSTANTIATE_TEST_SUITE_P(Full, ImplicitPulse, testing::Values(1, 2, 5, 100), name_of_number);

}  // namespace
}  // namespace sluice::verification::implicit_waves_test
