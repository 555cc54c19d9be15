// Semi-implicit steps on two levels: pulses with noise never grow, layers stay at rest, closed
// boxes keep their totals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/archive.hpp"
#include "verification/amr_case.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::implicit_levels_test {
namespace {

// --- the pulse with noise; the finer level is the middle half of 64 cells ---

constexpr double height = 1e-3;
// Of the height. Measured after 5,000 steps at most 1.4e-3 (half a cell of sound a step) to 2.4e-12
// (100); 500 cells: 6.4e-11 between walls, 3.0e-3 where periodic, there with every second step
// redone. Energy at most .60 of the start, in the first output.
constexpr double allowed_checkerboard = 0.02;

// Energy of the disturbance; the largest checkerboard of the three stretches of equal cells, in
// heights of the pulse.
struct Disturbance {
  double energy = 0, checkerboard = 0;
};
Disturbance disturbance(const CaseRun& run, const std::string& when) {
  const std::vector<LevelCell> p = level_cells(run, "press_CC", 0, when);
  const std::vector<LevelCell> u = level_cells(run, "vel_CC", 0, when);
  Disturbance d;
  double stripes = 0;
  int faces = 0;
  for (std::size_t n = 0; n < p.size(); ++n) {
    if (p[n].covered) continue;
    const double rise = p[n].value - 1;
    d.energy += p[n].volume * (rise * rise / 2.8 + 0.7 * u[n].value * u[n].value);
    if (n > 0 && !p[n - 1].covered && p[n - 1].level == p[n].level) {
      stripes += (p[n].cell.x % 2 == 0 ? 1 : -1) * (p[n].value - p[n - 1].value);
      ++faces;
    }
    const bool ends = n + 1 == p.size() || p[n + 1].covered || p[n + 1].level != p[n].level;
    if (!ends) continue;
    d.checkerboard = std::max(d.checkerboard, std::fabs(stripes) / (2 * faces) / height);
    stripes = 0;
    faces = 0;
  }
  return d;
}

void expect_no_growth(const Overrides& more) {
  const CaseRun run("amr_implicit_pulse", more);
  const Disturbance start = disturbance(run, "first");
  EXPECT_NEAR(start.checkerboard, 0.5, 1e-3);
  const auto outputs = static_cast<int>(Archive::open(run.archive()).outputs().size());
  double largest = 0;
  Disturbance now;
  for (int n = 1; n < outputs; ++n) {
    now = disturbance(run, "#" + std::to_string(n));
    largest = std::max(largest, now.energy / start.energy);
  }
  record("energy", largest);
  record("energy at the end", now.energy / start.energy);
  record("checkerboard", now.checkerboard);
  record("events", static_cast<double>(run.events()));
  EXPECT_LE(largest, 1);
  EXPECT_LE(now.checkerboard, allowed_checkerboard);
}

const Overrides periodic{"Grid/Level[1]/periodic=[1,1,1]", "Grid/Level[1]/Box/extraCells=[0,0,0]"};

// Sound crosses so many cells of the finer level in a step; corrections to 1e-4 of the first error.
Overrides pulse(double C, int steps, int outputs) {
  return steps_of(C / 128, steps, outputs) + solved(20, 1e-7, 1e-10);
}

class ImplicitPulseOnLevels : public testing::TestWithParam<double> {};

TEST_P(ImplicitPulseOnLevels, NeverGrows) {
  expect_no_growth(pulse(GetParam(), 60, 6));
}

INSTANTIATE_TEST_SUITE_P(CellsOfSound, ImplicitPulseOnLevels, testing::Values(5, 100),
                         testing::PrintToStringParamName());

class ImplicitLongPulseOnLevels : public testing::TestWithParam<double> {};

TEST_P(ImplicitLongPulseOnLevels, BetweenWallsNeverGrowsInFiveThousandSteps) {
  expect_no_growth(pulse(GetParam(), 5000, 100));
}
TEST_P(ImplicitLongPulseOnLevels, PeriodicNeverGrowsInFiveThousandSteps) {
  expect_no_growth(pulse(GetParam(), 5000, 100) + periodic);
}

// Steps of 1, .1, .9, .2, .8, ... of the longest, between outputs and checkpoints.
TEST_P(ImplicitLongPulseOnLevels, NeverGrowsWhenStepsChange) {
  const double dt = GetParam() / 128;
  expect_no_growth(pulse(GetParam(), 200, 200) +
                   Overrides{"Time/clamp_time_to_output=true",
                             fmt::format("DataArchiver/checkpoint/@interval={:.17g}", 1.1 * dt)});
}

INSTANTIATE_TEST_SUITE_P(Full, ImplicitLongPulseOnLevels,
                         testing::Values(0.5, 1, 2, 5, 20, 100, 500), [](const auto& test) {
                           return test.param < 1 ? std::string("half")
                                                 : std::to_string(static_cast<int>(test.param));
                         });

// --- rest under gravity; the finer level ends in the liquid and in the air ---

constexpr double rest = 1e-12;  // of the sound speed of air; measured 1.9e-14 (C 400)
constexpr double slug_sound = 1625, least_sound = 374;  // m/s

double rest_of_layers(double C, int steps) {
  const CaseRun run("amr_implicit_layers_at_rest", steps_of(C / 64 / slug_sound, steps));
  double fastest = 0;
  for (int m = 0; m < 2; ++m)
    for (int c = 0; c < 2; ++c)
      for (const LevelCell& cell : level_cells(run, "vel_CC", c, "last", m))
        if (!(std::fabs(cell.value) <= fastest)) fastest = std::fabs(cell.value);
  record("u", fastest / least_sound);
  EXPECT_EQ(run.events(), 0);
  return fastest / least_sound;
}

TEST(ImplicitRestOnLevels, LayersUnderGravityStayAtRest) {
  for (const double C : {0.5, 10., 100., 400.}) EXPECT_LE(rest_of_layers(C, 100), rest) << C;
}
TEST(FullImplicitRestOnLevels, LayersStayAtRestForHundredThousandSteps) {
  EXPECT_LE(rest_of_layers(100, 100000), rest);
}

// --- closed boxes whose finer levels follow the flow ---

constexpr double allowed_drift = 1e-12;  // of sum |q|, per 1,000 steps; measured 1.1e-14

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}
const Overrides lockstep{"AMR/useLockStep=true"};

class ImplicitBoxOnLevels : public testing::TestWithParam<double> {};

TEST_P(ImplicitBoxOnLevels, KeepsItsTotalsWhateverTheTolerance) {
  const CaseRun run("amr_periodic_shocks", lockstep + solved(20, 1e-3, GetParam()) + until(0.01) +
                                               Overrides{resolution(50)});
  EXPECT_GE(regrids(run), 2);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

class ImplicitLongRunOnLevels : public testing::TestWithParam<double> {};

TEST_P(ImplicitLongRunOnLevels, KeepsItsTotalsWhateverTheTolerance) {
  const CaseRun gas("amr_periodic_shocks", lockstep + solved(20, 1e-3, GetParam()) + until(0.3));
  EXPECT_GE(gas.steps(), 1000);
  EXPECT_LE(drift_per_thousand(gas), allowed_drift);
  const CaseRun mixture("amr_mixed_gas_water", lockstep + solved(20, 1e-3, GetParam()));
  EXPECT_GE(regrids(mixture), 100);
  EXPECT_LE(drift_per_thousand(mixture), allowed_drift);
  // Under gravity, in steps in which sound crosses many cells.
  const CaseRun ball(
      "amr_implicit_blob",
      Overrides{fmt::format("CFD/ICE/ImplicitSolver/Parameters/tolerance={:g}", GetParam())});
  EXPECT_LE(drift_per_thousand(ball), allowed_drift);
}

const auto name_of = [](const auto& test) { return test.param > 1e-3 ? "loose" : "tight"; };
INSTANTIATE_TEST_SUITE_P(Tolerances, ImplicitBoxOnLevels, testing::Values(1e-2, 1e-12), name_of);
INSTANTIATE_TEST_SUITE_P(Full, ImplicitLongRunOnLevels, testing::Values(1e-2, 1e-12), name_of);

}  // namespace
}  // namespace sluice::verification::implicit_levels_test
