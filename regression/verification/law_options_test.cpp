// Each equation of state with each option of the flow: a uniform state at rest stays, and what is
// saved of its law is that of the state by differences of the law's own pressure and energy.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "verification/case_run.hpp"
#include "verification/law_deck.hpp"

namespace sluice::verification::law_options_test {
namespace {

constexpr double allowed = 1e-11;  // of rho, p, T; of velocities as a share of c

struct Option {
  const char* name;
  std::vector<std::string> overrides;
  bool periodic = true;
  const char* finer = "";
  const char* formula_of = "";  // which of density, pressure, temperature a formula gives
  bool lodi = false;
};

const std::string ice = "CFD/ICE/", material = "MaterialProperties/ICE/material/",
                  implicit = ice + "ImplicitSolver/";
constexpr const char* finer_half =
    "<Level><Box label=\"finer\"><lower>[-0.25,0,0]</lower><upper>[0.25,0.01,0.01]</upper>"
    "<resolution>[20,1,1]</resolution></Box><periodic>[0,1,1]</periodic></Level>";

const Option options[] = {
    {"Plain", {}},
    {"FirstOrder", {ice + "advection/@type=FirstOrder"}},
    {"ConductionAndViscosity",
     {material + "thermal_conductivity=1", material + "dynamic_viscosity=1e-3"}},
    {"Turbulence",
     {ice + "turbulence/@model=Smagorinsky", ice + "turbulence/model_constant=0.17",
      "Grid/Level[1]/Box/resolution=[6,6,6]", "Grid/Level[1]/Box/upper=[0.5,1,1]"}},
    {"OpenEnds", {}, false},
    {"WavesThatLeave", {}, false, "", "", true},
    {"Implicit",
     {implicit + "max_outer_iterations=1", implicit + "outer_iteration_tolerance=1e-6",
      implicit + "Parameters/@variable=implicitPressure", implicit + "Parameters/tolerance=1e-10"}},
    {"Levels", {}, true, finer_half},
    {"FormulaOfPressureAndTemperature", {}, true, "", "pT"},
    {"FormulaOfDensityAndTemperature", {}, true, "", "rT"},
    {"FormulaOfDensityAndPressure", {}, true, "", "rp"},
};

// Ends that let waves leave.
void add_lodi(double p, std::vector<std::string>& to) {
  const std::string sides = "Grid/BoundaryConditions/";
  to.push_back(fmt::format("{}LODI/press_infinity={:.17g}", sides, p));
  to.push_back(sides + "LODI/sigma=0.27");
  to.push_back(sides + "LODI/material=body");
  for (int face = 1; face <= 2; ++face)
    for (int type = 1; type <= 4; ++type)
      to.push_back(fmt::format("{}Face[{}]/BCType[{}]/@var=LODI", sides, face, type));
}

std::ostream& operator<<(std::ostream& out, const Option& option) {
  return out << option.name;
}

std::vector<std::string> overrides_of(const Option& option, const LawCase& law, double p) {
  std::vector<std::string> all = {"Time/max_Timesteps=3", "Grid/Level[1]/Box/resolution=[20,1,1]"};
  if (option.lodi) add_lodi(p, all);
  all.insert(all.end(), option.overrides.begin(), option.overrides.end());
  const std::string formula = ice + "customInitialization/formula/", of = option.formula_of;
  if (of.find('r') != of.npos)
    all.push_back(fmt::format("{}density={:.17g}", formula, law.density));
  if (of.find('p') != of.npos) all.push_back(fmt::format("{}pressure={:.17g}", formula, p));
  if (of.find('T') != of.npos)
    all.push_back(fmt::format("{}temperature={:.17g}", formula, law.temperature));
  return all;
}

class EveryLawWith : public testing::TestWithParam<Option> {};

TEST_P(EveryLawWith, KeepsAStateAndTellsItsHeats) {
  const TemporaryFolder folder;
  for (const LawCase& law : law_cases()) {
    SCOPED_TRACE(law.name);
    const ice::Fluid fluid = fluid_of(law);
    const double rho = law.density, T = law.temperature;
    const auto energy = [&](double r, double t) { return fluid.energy_from_temperature(r, t); };
    const double E = energy(rho, T), p = fluid.pressure(rho, E);
    const double c = fluid.sound_speed(rho, p);
    if (GetParam().lodi && !(p > 0)) continue;  // refused: the pressure far away is above 0
    // A law whose pressure knows the density alone has no energy of a pressure.
    if (GetParam().formula_of == std::string("rp") && !fluid.depends_on_energy()) continue;
    const auto deck =
        write_law_deck(folder.path(), law, 0, 0, 1, GetParam().periodic, GetParam().finer);
    const CaseRun run(deck.string(), overrides_of(GetParam(), law, p));
    EXPECT_EQ(run.steps(), 3);
    EXPECT_LT(farthest_from(run.field("rho_CC"), rho), allowed * rho);
    EXPECT_LT(farthest_from(run.field("press_CC"), p), allowed * (std::fabs(p) + rho * c * c));
    EXPECT_LT(farthest_from(run.field("temp_CC"), T),
              allowed * T * (1 + std::fabs(E) / (rho * c * c)));
    for (int d = 0; d < 3; ++d) EXPECT_LT(farthest_from(run.field("vel_CC", d), 0), allowed * c);
    // cv = de/dT, cp/cv = c^2/(dp/drho) at constant temperature.
    const double dT = 1e-3 * T, dr = 1e-5 * rho;
    const double cv = (energy(rho, T + dT) - energy(rho, T - dT)) / (2 * dT * rho);
    const double isothermal = (fluid.pressure(rho + dr, energy(rho + dr, T)) -
                               fluid.pressure(rho - dr, energy(rho - dr, T))) /
                              (2 * dr);
    EXPECT_NEAR(run.field("specific_heat").at(0), cv, 1e-5 * cv);
    EXPECT_NEAR(run.field("speedSound_CC").at(0), c, 1e-9 * c);
    const bool one_entropy =
        law.name != std::string("Tillotson");  // its temperature is no part of it
    if (one_entropy) {
      EXPECT_NEAR(run.field("gamma").at(0) * isothermal, c * c, 1e-4 * c * c);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Option, EveryLawWith, testing::ValuesIn(options),
                         [](const auto& test) { return std::string(test.param.name); });

// A law that decks name and no case has would go untested here.
TEST(LawCases, AreOfAllLaws) {
  std::set<std::string> tested;
  for (const LawCase& law : law_cases())
    tested.insert(std::string(eos::name_of(fluid_of(law).law)));
  eos::AllLaws::for_each(
      [&]<class Law>() { EXPECT_EQ(tested.count(std::string(Law::name)), 1U) << Law::name; });
}

}  // namespace
}  // namespace sluice::verification::law_options_test
