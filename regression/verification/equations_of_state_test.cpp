// Every equation of state and specific heat from a deck: two streams that collide against the
// Rankine-Hugoniot relations of the law, uniform flow, conservation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eos/bracketed_root.hpp"
#include "framework/base/temporary_folder.hpp"
#include "verification/case_run.hpp"
#include "verification/law_deck.hpp"

namespace sluice::verification::equations_of_state_test {
namespace {

// Of the jumps of pressure and density, half way between the middle and the shock;
// 200 cells. Measured: at most 3.8e-4 and 4.8e-4 (Murnaghan, airNasa).
constexpr double allowed_jump = 1e-3;
// Distance of the steepest rise from where the shock must be, in cells. Measured: 0.
constexpr double allowed_position = 1.01;
constexpr double allowed_uniformity = 1e-12;
constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps; measured: 7.6e-16

struct Shock {
  double density, pressure, speed;  // behind it; speed towards the oncoming stream
};

// Behind a shock that stops a stream of this speed: e2 - e1 = (p1 + p2)(v1 - v2)/2 with
// (p2 - p1)(v1 - v2) = speed^2.
Shock stopped(const ice::Fluid& fluid, double rho1, double e1, double speed) {
  const double p1 = fluid.pressure(rho1, rho1 * e1);
  const auto behind = [&](double rho2) {
    const double dv = 1 / rho1 - 1 / rho2, p2 = p1 + speed * speed / dv;
    const double e2 = e1 + 0.5 * (p1 + p2) * dv;
    return std::pair(p2, fluid.pressure(rho2, rho2 * e2) - p2);
  };
  // The law's pressure minus that of the momentum balance rises with the density.
  double low = rho1 * (1 + 1e-9), high = low;
  while (!(behind(high).second >= 0)) high = rho1 + 1.05 * (high - rho1);
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    (behind(middle).second < 0 ? low : high) = middle;
  }
  return {high, behind(high).first, speed * rho1 / (high - rho1)};
}

class OneLaw : public testing::TestWithParam<LawCase> {
 protected:
  OneLaw() : fluid_(fluid_of(GetParam())) {
    const LawCase& law = GetParam();
    energy_ = fluid_.energy_from_temperature(law.density, law.temperature) / law.density;
    pressure_ = fluid_.pressure(law.density, law.density * energy_);
  }
  TemporaryFolder folder_;
  ice::Fluid fluid_;
  double energy_ = 0, pressure_ = 0;
};

TEST_P(OneLaw, CollidingStreamsFollowRankineAndHugoniot) {
  const LawCase& law = GetParam();
  const Shock shock = stopped(fluid_, law.density, energy_, law.speed);
  const double end = 0.3 / shock.speed;
  const auto deck = write_law_deck(folder_.path(), law, law.speed, -law.speed, end, false);
  const CaseRun run(deck.string());
  const CellValues p = run.field("press_CC"), rho = run.field("rho_CC");
  const int half_way = 130;  // x = 0.1525
  const double jump = shock.pressure - pressure_;
  record("pressure", std::abs(p.at(half_way) - shock.pressure) / jump);
  record("density", std::abs(rho.at(half_way) - shock.density) / (shock.density - law.density));
  EXPECT_NEAR(p.at(half_way), shock.pressure, allowed_jump * jump);
  EXPECT_NEAR(rho.at(half_way), shock.density, allowed_jump * (shock.density - law.density));
  int steepest = 101;
  for (int i = 101; i < 198; ++i)
    if (p.at(i) - p.at(i + 1) > p.at(steepest) - p.at(steepest + 1)) steepest = i;
  const double position = 0.5 * (p.centre(steepest).x + p.centre(steepest + 1).x);
  record("position", (position - 0.3) / p.spacing.x);
  EXPECT_NEAR(position, 0.3, allowed_position * p.spacing.x);
  EXPECT_EQ(run.events(), 0);
}

TEST_P(OneLaw, UniformFlowStaysUniform) {
  const LawCase& law = GetParam();
  const double c = fluid_.sound_speed(law.density, pressure_);
  const CaseRun run(write_law_deck(folder_.path(), law, 0.3 * c, 0.3 * c, 0.5 / c, true).string());
  const double stiffness = fluid_.bulk_modulus(law.density, pressure_);
  EXPECT_LE(farthest_from(run.field("rho_CC"), law.density), allowed_uniformity * law.density);
  EXPECT_LE(farthest_from(run.field("press_CC"), pressure_),
            allowed_uniformity * std::max(stiffness, std::abs(pressure_)));
  EXPECT_LE(farthest_from(run.field("vel_CC"), 0.3 * c), allowed_uniformity * c);
}

TEST_P(OneLaw, PeriodicShocksConserve) {
  const LawCase& law = GetParam();
  const double c = fluid_.sound_speed(law.density, pressure_);
  // The ends part where the streams meet in the middle, so that the law bears it: a tenth.
  const CaseRun run(
      write_law_deck(folder_.path(), law, 0.1 * law.speed, -0.1 * law.speed, 2 / c, true).string());
  record("drift", run.worst_drift());
  EXPECT_LE(run.worst_drift() / std::max(1., run.steps() / 1000.), allowed_drift);
}

INSTANTIATE_TEST_SUITE_P(All, OneLaw, testing::ValuesIn(law_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::equations_of_state_test
