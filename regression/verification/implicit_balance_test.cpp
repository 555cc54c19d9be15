// Semi-implicit steps: what must hold whatever the solve leaves. Totals in closed boxes, contacts
// of water and air at uniform pressure and velocity, rest under gravity, uniform inflow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/case_run.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::implicit_balance_test {
namespace {

constexpr double allowed_drift = 1e-12;  // of sum |q|, per 1,000 steps; measured at most 3e-16
constexpr double uniform = 1e-10;        // of p, u; measured 9.5e-11 (C 400), else 1e-11
// Pressure of the law in a cell that the slug has nearly left, C 400; 1e-14 of water's modulus.
constexpr double uniform_law = 1e-9;  // of p; measured 2.8e-10, else 1.5e-11
constexpr double slug_sound = 1625;   // m/s, of water by its stiffened law
constexpr double least_sound = 374;   // m/s, of the air of density 1
constexpr double rest = 1e-12;        // of the sound speed; measured at most 2.1e-14 (C 400)

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}

class ImplicitBox : public testing::TestWithParam<double> {};

TEST_P(ImplicitBox, KeepsItsTotalsWhateverTheTolerance) {
  const CaseRun mixture("closed_box", solved(1, 1e-6, GetParam()) + until(0.0016));
  EXPECT_LE(drift_per_thousand(mixture), allowed_drift);
  const CaseRun gas("blast_2d", solved(20, 1e-3, GetParam()) + Overrides{resolution(24, 24)});
  EXPECT_LE(drift_per_thousand(gas), allowed_drift);
  EXPECT_GT(lowest(gas.field("press_CC")), 0);
}

TEST_P(ImplicitBox, FullThousandSteps) {
  const CaseRun mixture("closed_box", solved(1, 1e-6, GetParam()));
  EXPECT_GE(mixture.steps(), 1000);
  EXPECT_LE(drift_per_thousand(mixture), allowed_drift);
  // Steps in which sound crosses many cells.
  const CaseRun swift("closed_box", solved(1, 1e-6, GetParam()) + sound_is_free() +
                                        Overrides{"Time/max_delt_increase=0.25"});
  EXPECT_LE(drift_per_thousand(swift), allowed_drift);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, ImplicitBox, testing::Values(1e-2, 1e-12),
                         [](const auto& test) { return test.param > 1e-3 ? "loose" : "tight"; });

class ImplicitContact : public testing::TestWithParam<int> {};

TEST_P(ImplicitContact, OfWaterAndAirKeepsPressureAndVelocity) {
  const int C = GetParam();
  const double dt = C * 0.01 / slug_sound;
  const CaseRun run("implicit_water_air", steps_of(dt, std::min(200, 12000 / C)));
  const double p = farthest_from(run.field("press_CC"), 1e5) / 1e5;
  const double law = farthest_from(run.field("press_equil_CC"), 1e5) / 1e5;
  const double u = farthest_from(run.field("vel_CC"), 1);
  record("p", p);
  record("p_of_the_law", law);
  record("u", u);
  EXPECT_LE(p, uniform);
  EXPECT_LE(law, uniform_law);
  EXPECT_LE(u, uniform);
  EXPECT_EQ(run.events(), 0);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

INSTANTIATE_TEST_SUITE_P(CellsOfSound, ImplicitContact, testing::Values(1, 10, 100, 400),
                         testing::PrintToStringParamName());

// Fronts stay sharp: cells with both materials, of 100.
TEST(ImplicitContactFronts, OfACarriedSlugStayNarrow) {
  constexpr int widest = 8;  // of two fronts; measured 6
  const CaseRun run("implicit_water_air");
  const CellValues share = run.field("vol_frac_CC");
  int mixed = 0;
  for (const double V : share.values) mixed += V > 1e-3 && V < 1 - 1e-3;
  record("mixed", mixed);
  EXPECT_LE(mixed, widest);
}

double rest_of_layers(double C, int steps, const Overrides& more = {}) {
  const CaseRun run("implicit_layers_at_rest", steps_of(C / 32 / slug_sound, steps) + more);
  double fastest = 0;
  for (int m = 0; m < 2; ++m)
    for (int c = 0; c < 2; ++c)
      fastest = std::max(fastest, farthest_from(run.field("vel_CC", c, "last", m), 0));
  record("u", fastest / least_sound);
  EXPECT_EQ(run.events(), 0);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  return fastest / least_sound;
}

TEST(ImplicitRest, LayersUnderGravityStayAtRest) {
  for (const double C : {0.5, 10., 100., 400.}) EXPECT_LE(rest_of_layers(C, 200), rest) << C;
}

TEST(ImplicitRest, LayersStayAtRestInTheirPlane) {
  const Overrides plane{resolution(8, 32), "Grid/Level/Box/upper=[0.25,1,0.03125]"};
  EXPECT_LE(rest_of_layers(100, 50, plane), rest);
  EXPECT_LE(rest_of_layers(100, 50, plane + solved(1, 1e-6, 1e-2)), rest);
}

// Where velocity, density and temperature are given. Measured: 1.6e-15 of p, 7e-12 m/s.
TEST(ImplicitInflow, StaysUniform) {
  const CaseRun run("implicit_inflow");
  EXPECT_GE(run.steps(), 60);
  EXPECT_LE(farthest_from(run.field("press_CC"), 101325), uniform * 101325);
  EXPECT_LE(farthest_from(run.field("vel_CC", 0), 0.03), 1e-9);
  EXPECT_LE(farthest_from(run.field("vel_CC", 1), 0), 1e-9);
}

TEST(FullImplicitRest, LayersStayAtRestForHundredThousandSteps) {
  EXPECT_LE(rest_of_layers(100, 100000), rest);
}

}  // namespace
}  // namespace sluice::verification::implicit_balance_test
