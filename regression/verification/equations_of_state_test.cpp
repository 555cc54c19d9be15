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

#define JWL_TNT \
  "<A>371.2e9</A><B>3.231e9</B><R1>4.15</R1><R2>0.95</R2><om>0.3</om><rho0>1630</rho0>"

const LawCase cases[] = {
    {"ideal_gas", R"(<EOS type="ideal_gas"/>)", 1.4, 717.5, 1.2, 300, 400},
    {"StiffenedGas", R"(<EOS type="StiffenedGas"><pinf>6e8</pinf></EOS>)", 4.4, 300, 1000, 600,
     300},
    {"hard_sphere_gas", R"(<EOS type="hard_sphere_gas"><b>1e-3</b></EOS>)", 1.3, 1100, 100, 2000,
     600},
    {"TST", R"(<EOS type="TST"><a>300</a><b>1e-3</b><u>-0.5</u><w>3</w><Gamma>1.4</Gamma></EOS>)",
     1.4, 1500, 50, 600, 300},
    {"JWL", R"(<EOS type="JWL">)" JWL_TNT "</EOS>", 1.3, 1000, 1630, 3000, 500},
    {"JWLC", R"(<EOS type="JWLC">)" JWL_TNT "<C>1.045e9</C></EOS>", 1.3, 1000, 1630, 3000, 500},
    {"Murnaghan",
     R"(<EOS type="Murnaghan"><n>7.4</n><K>39e-11</K><rho0>1160</rho0><P0>101325</P0></EOS>)", 1.4,
     1400, 1200, 300, 100},
    {"BirchMurnaghan",
     R"(<EOS type="BirchMurnaghan"><n>5</n><K>7e-11</K><rho0>2000</rho0><P0>101325</P0></EOS>)",
     1.4, 900, 2050, 300, 200},
    {"MieGruneisen",
     R"(<EOS type="MieGruneisen"><C0>3940</C0><S>1.489</S><Gamma0>2.02</Gamma0><rho0>8930</rho0>)"
     "<T0>294</T0></EOS>",
     1, 385, 8940, 294, 500},
    {"Gruneisen",
     R"(<EOS type="Gruneisen"><A>1.3338e9</A><B>7.027e5</B><rho0>1823.3</rho0><T0>317.4</T0>)"
     "<P0>101325</P0></EOS>",
     1, 820.7, 1823.3, 320, 50},
    {"Tillotson",
     R"(<EOS type="Tillotson"><a>0.5</a><b>1.63</b><A>75.2e9</A><B>65e9</B><E0>5e6</E0>)"
     "<Es>3e6</Es><Esp>13.9e6</Esp><alpha>5</alpha><beta>5</beta><rho0>2700</rho0></EOS>",
     1, 900, 2710, 300, 1000},
    {"Thomsen_Hartka_water",
     R"(<EOS type="Thomsen_Hartka_water"><a>2e-7</a><b>2.6</b><co>4205.7</co><ko>5e-10</ko>)"
     "<To>277</To><L>8e-6</L><vo>1.00008e-3</vo></EOS>",
     1, 4205, 1010, 300, 20},
    {"KnaussSeaWater", R"(<EOS type="KnaussSeaWater"/>)", 1, 3990, 1030, 290, 20},
    {"airNasa", R"(<EOS type="ideal_gas"/><SpecificHeatModel type="airNasa"/>)", 1.4, 717.5, 1.2,
     300, 1500},
    {"Component",
     R"(<EOS type="ideal_gas"/><SpecificHeatModel type="Component"><XCO2>0.2</XCO2>)"
     "<XH2O>0.3</XH2O><XN2>0.5</XN2></SpecificHeatModel>",
     1.25, 1184, 5, 2000, 1000},
    {"Polynomial",
     R"(<EOS type="ideal_gas"/><SpecificHeatModel type="Polynomial"><MaxOrder>7</MaxOrder>)"
     "<coefficient>[-8.330700e14, 1.811170e14, -1.426913e13, 5.305770e11, -9.958630e9, 9.237480e7, "
     "-3.85805e5, 1476.8]</coefficient><Tmin>250</Tmin></SpecificHeatModel>",
     1.3, 1200, 5, 2000, 1000},
    {"Debye",
     R"(<EOS type="StiffenedGas"><pinf>2e10</pinf></EOS><SpecificHeatModel type="Debye">)"
     "<Atoms>9.48e24</Atoms><DebyeTemperature>343</DebyeTemperature></SpecificHeatModel>",
     3, 385, 8900, 500, 300},
};

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

INSTANTIATE_TEST_SUITE_P(All, OneLaw, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::equations_of_state_test
