// Sources of models and bodies against closed forms: mass that becomes another material's, heat, a
// driving force, a region that is held; what they add is what the totals gain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "framework/base/test_support/environment.hpp"
#include "verification/amr_case.hpp"

namespace sluice::verification::sources_test {
namespace {

// Shares of sum |q|, per 1,000 steps. Measured: at most 6e-15.
constexpr double allowed_drift = 1e-13;
// Of values that follow a closed form. Measured: at most 3e-14.
constexpr double round_off = 1e-12;
// Where levels meet, what is matched between them after a step has not decayed in it: of first
// order in the step. Measured: 1.6e-4.
constexpr double on_levels = 5e-4;
// The momentum that an accelerated flow carries in one step and in two differs in second order: it
// is disturbed where levels meet, under gravity as well. Measured: 7.6e-4.
constexpr double accelerated_on_levels = 2e-3;

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}

// The last value of a .dat history; `column` 0 is the first after the time.
double last_of_history(const CaseRun& run, const std::string& label, int column = 0) {
  std::ifstream file(run.archive() / (label + ".dat"));
  double value = std::nan("");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    for (char& c : line)
      if (c == '[' || c == ']' || c == ',') c = ' ';
    const char* at = line.c_str();
    char* end = nullptr;
    std::vector<double> numbers;
    for (double x = std::strtod(at, &end); end != at; x = std::strtod(at, &end)) {
      numbers.push_back(x);
      at = end;
    }
    // Some files begin with a column of steps.
    const std::size_t values = label == "TotalModelMom_src" ? 3 : 1;
    if (numbers.size() > values)
      value = numbers[numbers.size() - values + static_cast<std::size_t>(column)];
  }
  return value;
}

double of_conservation(const CaseRun& run, const std::string& quantity, const std::string& what) {
  return run.record().at("conservation").at(quantity).at(what).get<double>();
}

const char* const one_level = "AMR/Regridder/max_levels=1";

TEST(MassExchange, IsTheExponentialWhateverFlows) {
  const CaseRun run("amr_mass_exchange", {one_level});
  const double start = of_conservation(run, "mass of material 1", "start");
  const double now = of_conservation(run, "mass of material 1", "now");
  record("error", now / (start * std::exp(-5.)) - 1);
  EXPECT_NEAR(now / (start * std::exp(-5.)), 1, round_off);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_NEAR(last_of_history(run, "totalMassExchanged") / (start - now), 1, round_off);
  EXPECT_GT(last_of_history(run, "totalIntEngExchanged"), 0);
  // What models only move they do not add.
  EXPECT_LE(std::fabs(last_of_history(run, "TotalModelMass_src")), round_off * start);
  EXPECT_LE(std::fabs(last_of_history(run, "TotalModelEng_src")), round_off);
  for (int d = 0; d < 3; ++d)
    EXPECT_LE(std::fabs(last_of_history(run, "TotalModelMom_src", d)), round_off * start);
  // The pressure falls where a gas of larger gamma goes.
  EXPECT_LT(lowest(run.field("press_CC")), 0.95);
}

TEST(MassExchange, KeepsTotalsOnLevels) {
  const CaseRun run("amr_mass_exchange");
  const double start = of_conservation(run, "mass of material 1", "start");
  const double now = of_conservation(run, "mass of material 1", "now");
  record("error", now / (start * std::exp(-5.)) - 1);
  EXPECT_NEAR(now / (start * std::exp(-5.)), 1, on_levels);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

// Nothing passes before the start, which lies inside a step.
TEST(MassExchange, StartsWhenItSays) {
  const CaseRun run("amr_mass_exchange", {one_level, "Models/Model/Test/startTime=0.1001"});
  const double start = of_conservation(run, "mass of material 1", "start");
  const double now = of_conservation(run, "mass of material 1", "now");
  EXPECT_NEAR(now / (start * std::exp(-20. * (.25 - .1001))), 1, round_off);
}

// The public suite's deck, from time 0 until the reactant is used up.
TEST(FullMassExchange, RunsUntilNothingIsLeft) {
  const auto decks = folder_in_environment("SLUICE_DECKS");
  if (!decks) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  const CaseRun run((*decks / "inputs/ICE/massX.ups").string(),
                    {"Models/Model/Test/startTime=0", "Time/max_Timesteps=100000",
                     "Time/maxTime=0.4", "DataArchiver/outputTimestepInterval=100000"});
  EXPECT_EQ(of_conservation(run, "mass of material 1", "now"), 0);
  const double start = of_conservation(run, "mass of material 1", "start");
  EXPECT_GT(start, 0);
  EXPECT_NEAR(of_conservation(run, "mass of material 1", "sources") / start, -1, round_off);
  // The gas is at rest: its momentum is round-off, and has no scale.
  for (const char* quantity : {"mass of material 0", "mass of material 1", "total energy"})
    EXPECT_LE(std::fabs(of_conservation(run, quantity, "drift")), allowed_drift) << quantity;
  EXPECT_LE(farthest_from(run.field("press_CC"), 101325) / 101325, 1e-3);
}

std::vector<std::string> added_heat(const char* power, const char* start, const char* stop) {
  const std::string block = "CFD/ICE/ADD_HEAT/";
  return {block + "add_heat_matls=[0]", block + "add_heat_coeff=[" + power + "]",
          block + "add_heat_t_start=" + start, block + "add_heat_t_final=" + stop};
}

// Constant volume: dT/dt = q/cv between the times, neither of which is the end of a step.
TEST(AddedHeat, RaisesTheTemperatureOfAUniformFlowExactly) {
  const CaseRun before("uniform_flow");
  const CaseRun run("uniform_flow", added_heat("2", "0.0101", "0.0707"));
  const double cold = before.field("temp_CC", 0, "first").values.front();
  const double warm = lowest(run.field("temp_CC"));
  const double pressure = lowest(run.field("press_CC")) / lowest(before.field("press_CC"));
  const double E = of_conservation(run, "total energy", "sources");
  const double M = of_conservation(run, "mass of material 0", "now");
  record("energy", E / (M * 2 * .0606) - 1);
  EXPECT_NEAR(E / (M * 2 * .0606), 1, round_off);
  EXPECT_NEAR(warm / cold, pressure, round_off);
  EXPECT_NEAR(highest(run.field("temp_CC")) / warm, 1, round_off);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
}

std::vector<std::string> driven(const char* x, const char* y) {
  const std::string block = "CFD/ICE/fixedPressureGradient/";
  return {block + "x_dir=" + x, block + "y_dir=" + y};
}

// u = u_0 + f t/rho, and nothing else changes.
void expect_driven(const std::string& deck, const char* x, const char* y, double allowed,
                   const std::vector<std::string>& options = {}) {
  const CaseRun run(deck, driven(x, y), options);
  const double f[2] = {std::stod(x), std::stod(y)};
  const double rho = run.field("rho_CC", 0, "first").values.front();
  for (int d = 0; d < 2; ++d) {
    const CellValues start = run.field("vel_CC", d, "first"), end = run.field("vel_CC", d);
    const double wanted = start.values.front() + f[d] * end.time / rho;
    const double scale = std::fabs(wanted) + std::fabs(start.values.front());
    record("velocity", farthest_from(end, wanted) / scale);
    EXPECT_LE(farthest_from(end, wanted), allowed * scale);
  }
  const double T = run.field("temp_CC", 0, "first").values.front();
  EXPECT_LE(farthest_from(run.field("temp_CC"), T), allowed * T);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_NE(of_conservation(run, "momentum x", "sources"), 0);
}

TEST(DrivingForce, AcceleratesAUniformFlowExactly) {
  expect_driven("uniform_flow", "0.3", "-0.2", round_off);
}

TEST(DrivingForce, AcceleratesAUniformFlowOnLevels) {
  expect_driven("amr_uniform_flow", "0.3", "-0.2", accelerated_on_levels, {"--max-steps", "10"});
}
TEST(FullDrivingForce, AcceleratesAUniformFlowOnLevels) {
  expect_driven("amr_uniform_flow", "0.3", "-0.2", accelerated_on_levels);
}

// Two gases by halves, each with a velocity of its own: the mixture goes as one gas, the gradient
// acts by volume (with the virtual mass of docs/theory/ice_velocities.md), drag holds.
TEST(DrivingForce, PushesMaterialsApartUntilDragHoldsThem) {
  for (const double K : {0., 2., 1e6}) {
    const CaseRun run("driven_mixture",
                      {"MaterialProperties/exchange_properties/exchange_coefficients/momentum=[" +
                       std::to_string(K) + "]"});
    const double f = .3, V = .5, a = .5 * .25, b = .5 * .14992503748125938, rho = a + b;
    const double inverse = 1 / a + 1 / b, virtual_mass = .125 * (a + b);
    const double push = f * V * (1 / a - 1 / b) / (1 + virtual_mass * inverse);
    const double rate = K * V * V * inverse, t = run.field("vel_CC", 0).time;
    const double apart = push * (K > 0 ? -std::expm1(-rate * t) / rate : t);
    const double ua = f * t / rho + apart * b / rho, ub = f * t / rho - apart * a / rho;
    record("first", farthest_from(run.field("vel_CC", 0, "last", 0), ua) / ua);
    EXPECT_LE(farthest_from(run.field("vel_CC", 0, "last", 0), ua), round_off * ua) << K;
    EXPECT_LE(farthest_from(run.field("vel_CC", 0, "last", 1), ub), round_off * ub) << K;
    EXPECT_LE(drift_per_thousand(run), allowed_drift) << K;
  }
}

// Mass that becomes another's takes its own velocity along; what mixing loses is heat.
void expect_the_velocity_of_the_giver(std::initializer_list<const char*> drags) {
  for (const char* K : drags) {
    const CaseRun run(
        "amr_mass_exchange",
        {std::string("MaterialProperties/exchange_properties/exchange_coefficients/momentum=[") +
             K + "]",
         "MaterialProperties/ICE/material[2]/geom_object/velocity=[3,-1,0]"});
    const double start = of_conservation(run, "mass of material 1", "start");
    const double now = of_conservation(run, "mass of material 1", "now");
    EXPECT_NEAR(now / (start * std::exp(-5.)), 1, on_levels) << K;
    EXPECT_LE(drift_per_thousand(run), allowed_drift) << K;
    EXPECT_LE(std::fabs(last_of_history(run, "TotalModelEng_src")), round_off) << K;
  }
}
TEST(MassExchange, BringsTheVelocityOfTheGiver) {
  expect_the_velocity_of_the_giver({"10"});
}
TEST(FullMassExchange, BringsTheVelocityOfTheGiver) {
  expect_the_velocity_of_the_giver({"0"});
}

TEST(HeldRegion, HasTheValuesOfTheDeck) {
  const CaseRun run("held_region");
  const auto worst = [&](const std::string& variable, int component, double wanted) {
    const CellValues field = run.field(variable, component, "#1");
    double distance = 0;
    for (int j = 0; j < field.size.y; ++j)
      for (int i = 0; i < field.size.x; ++i) {
        const Vec3 x = field.centre(i, j);
        if (x.x < .125 || x.x > .25 || x.y < .375 || x.y > .625) continue;
        distance = std::max(distance, std::fabs(field.at(i, j) - wanted) / wanted);
      }
    return distance;
  };
  EXPECT_EQ(worst("rho_CC", 0, .75), 0);
  EXPECT_LE(worst("vel_CC", 0, 1.5), 4e-16);
  EXPECT_LE(worst("vel_CC", 1, .25), 4e-16);
  EXPECT_LE(worst("temp_CC", 0, 4), 4e-16);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  const double gained = of_conservation(run, "mass of material 0", "now") -
                        of_conservation(run, "mass of material 0", "start");
  EXPECT_GT(gained, .001);
  EXPECT_NEAR(last_of_history(run, "TotalModelMass_src") / gained, 1, round_off);
  EXPECT_NEAR(last_of_history(run, "TotalModelMom_src", 0),
              of_conservation(run, "momentum x", "sources"), round_off);
  // Left alone after t = 0.3.
  EXPECT_GT(std::fabs(run.field("rho_CC").at(5, 15) - .75), 1e-3);
}

// What was counted is counted on after a restart.
TEST(HeldRegion, CountsOverRestarts) {
  const CaseRun whole("held_region");
  const std::string archive = (whole.folder() / "half").string();
  const CaseRun half("held_region", {"DataArchiver/checkpoint/@timestepInterval=20"},
                     {"--max-steps", "40"});
  const CaseRun rest("held_region", {}, {"--restart", half.archive().string()});
  EXPECT_EQ(last_of_history(rest, "TotalModelMass_src"),
            last_of_history(whole, "TotalModelMass_src"));
  EXPECT_EQ(of_conservation(rest, "total energy", "sources"),
            of_conservation(whole, "total energy", "sources"));
}

}  // namespace
}  // namespace sluice::verification::sources_test
