// Labels of a step against the change that they describe.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>

#include "sluice_source_dir.hpp"
#include "verification/amr_case.hpp"
#include "verification/implicit_case.hpp"

namespace sluice::verification::step_labels_test {
namespace {

constexpr double round_off = 1e-13;

std::vector<std::string> one_step(double dt, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"Time/max_Timesteps=1",
                                        "Time/delt_max=" + std::to_string(dt)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}
std::string drag(const char* coefficient) {
  return std::string("MaterialProperties/exchange_properties/exchange_coefficients/momentum=[") +
         coefficient + "]";
}

void add(CellValues& to, const CellValues& more) {
  for (std::size_t n = 0; n < to.values.size(); ++n) to.values[n] += more.values[n];
}

// In the middle of the ball nothing flows: the pressure falls by what passes to the other gas. The
// label is of first order in that, the difference of second.
TEST(StepLabels, PressureOfPassingMassIsTheChangeWhereNothingFlows) {
  for (const char* K : {"1e15", "0"}) {
    const auto change = [&](double dt) {
      const CaseRun run("amr_mass_exchange", one_step(dt, {one_level(), drag(K)}));
      const double all = run.field("delP_Dilatate").at(16, 16);
      const double passed = run.field("delP_MassX").at(16, 16);
      EXPECT_LT(all, -.1 * 20 * dt);
      EXPECT_EQ(run.field("delP_MassX").at(0, 0), 0);  // nothing passes there
      return std::pair{all, all - passed};
    };
    const auto [coarse, coarse_rest] = change(2e-4);
    const auto [fine, fine_rest] = change(1e-4);
    record("rest", fine_rest / fine);
    EXPECT_LE(std::fabs(fine_rest), .01 * std::fabs(fine)) << K;
    EXPECT_NEAR(coarse_rest / fine_rest, 4, .2) << K;
  }
}

// An ideal gas held at other values: its pressure goes with its energy alone.
TEST(StepLabels, PressureOfAHeldRegionIsTheChange) {
  for (const char* scheme : {"conservative", "classic"}) {
    const CaseRun run("held_region", one_step(1e-4, {std::string("CFD/ICE/scheme=") + scheme}));
    const CellValues before = run.field("press_CC", 0, "first"), after = run.field("press_CC");
    EXPECT_NEAR(run.field("delP_MassX").at(6, 16) / (after.at(6, 16) - before.at(6, 16)), 1, 1e-12)
        << scheme;
    EXPECT_EQ(run.field("delP_MassX").at(20, 16), 0);
  }
}

// Of both materials: momentum before, what the step gives, momentum before advection; the sum of
// what it gives is what the whole has gained between periodic sides. Before exchange and after it
// the energy is the same: exchange follows the advection.
TEST(StepLabels, MomentumOfPressureIsTheDifference) {
  for (const char* K : {"1e15", "10"}) {
    std::vector<std::string> two_steps = one_step(1e-3, {one_level(), drag(K)});
    two_steps[0] = "Time/max_Timesteps=2";
    two_steps.emplace_back("DataArchiver/outputTimestepInterval=1");
    const CaseRun run("amr_mass_exchange", two_steps);
    double gained = 0, size = 0;
    for (const int d : {0, 1}) {
      CellValues given = run.field("mom_source_CC", d), star = run.field("mom_L_ME_CC", d);
      add(given, run.field("mom_source_CC", d, "last", 1));
      add(star, run.field("mom_L_ME_CC", d, "last", 1));
      std::vector<double> before(given.values.size(), 0.0);
      for (const int m : {0, 1}) {
        const CellValues rho = run.field("rho_CC", 0, "#1", m), u = run.field("vel_CC", d, "#1", m);
        for (std::size_t n = 0; n < before.size(); ++n)
          before[n] += rho.values[n] * u.values[n] / (32. * 32 * 32);
      }
      for (std::size_t n = 0; n < before.size(); ++n) {
        EXPECT_NEAR(star.values[n] - before[n], given.values[n], round_off / (32. * 32 * 32));
        gained += given.values[n];
        size = std::fmax(size, std::fabs(given.values[n]));
      }
    }
    EXPECT_GT(size, 1e-4 / (32. * 32 * 32));
    EXPECT_LE(std::fabs(gained), round_off * size * 1024);
    for (const int m : {0, 1})
      EXPECT_EQ(run.field("int_eng_L_CC", 0, "last", m).values,
                run.field("eng_L_ME_CC", 0, "last", m).values);
  }
}

// A deck of inputs/ice that keeps these too, after each of two steps.
CaseRun run_that_saves(const std::string& deck, const std::vector<std::string>& labels,
                       const std::vector<std::string>& more = {}) {
  const TemporaryFolder folder;
  std::ifstream file(std::string(SLUICE_SOURCE_DIR "/inputs/ice/") + deck + ".ups");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::string saves;
  for (const std::string& label : labels) saves += "<save label=\"" + label + "\"/>";
  text.insert(text.find("<save "), saves);
  const std::regex interval("<output(Timestep)?Interval>[^<]*</output(Timestep)?Interval>");
  text = std::regex_replace(text, interval, "<outputTimestepInterval>1</outputTimestepInterval>");
  std::ofstream(folder / (deck + ".ups")) << text;
  std::vector<std::string> overrides = {"Time/max_Timesteps=2"};
  if (text.find("<AMR>") != std::string::npos) overrides.push_back(one_level());
  overrides.insert(overrides.end(), more.begin(), more.end());
  return CaseRun((folder / (deck + ".ups")).string(), overrides);
}

// A mixed gas, a liquid beside a gas, drops with a velocity of their own; on one level, for finer
// ones change coarse cells after the step.
TEST(StepLabels, RatesAreTheChangeBetweenOutputs) {
  for (const auto& [deck, materials] :
       {std::pair{"air_helium", 1}, std::pair{"water_air", 2}, std::pair{"amr_drops", 2}}) {
    const CaseRun run =
        run_that_saves(deck, {"temp_CC", "vel_CC", "vol_frac_CC", "dTdt_CC", "dVdt_CC"});
    for (int m = 0; m < materials; ++m) {
      const CellValues T = run.field("temp_CC", 0, "#1", m), now = run.field("temp_CC", 0, "#2", m);
      const CellValues u = run.field("vel_CC", 0, "#1", m), u_now = run.field("vel_CC", 0, "#2", m);
      const CellValues V = run.field("vol_frac_CC", 0, "#1", m);
      const CellValues V_now = run.field("vol_frac_CC", 0, "#2", m);
      const CellValues rate = run.field("dTdt_CC", 0, "#2", m);
      const CellValues force = run.field("dVdt_CC", 0, "#2", m);
      const double dt = now.time - T.time, fast = highest(u) - lowest(u) + 1;
      for (std::size_t n = 0; n < T.values.size(); ++n) {
        if (V.values[n] < 1e-6 || V_now.values[n] < 1e-6) continue;
        EXPECT_NEAR(rate.values[n] * dt, now.values[n] - T.values[n], round_off * T.values[n])
            << deck << ' ' << m << ' ' << n;
        EXPECT_NEAR(force.values[n] * dt, u_now.values[n] - u.values[n], round_off * fast)
            << deck << ' ' << m << ' ' << n;
      }
    }
  }
}

// The last number of a history.
double last_of(const CaseRun& run, const std::string& name) {
  std::ifstream file(run.archive() / (name + ".dat"));
  double last = std::nan("");
  for (std::string word; file >> word;) last = std::strtod(word.c_str(), nullptr);
  return last;
}

TEST(StepLabels, HistoriesOfPressureSolvesAreThoseOfTheStep) {
  constexpr double linear = 1e-2, outer = 1e-4;
  const CaseRun run = run_that_saves("taylor_green",
                                     {"pressure_passes", "pressure_iterations", "pressure_residual",
                                      "largest_volume_error", "volume_error"},
                                     solved(6, outer, linear) + sound_is_free());
  EXPECT_GE(last_of(run, "pressure_passes"), 1);
  EXPECT_GE(last_of(run, "pressure_iterations"), last_of(run, "pressure_passes"));
  EXPECT_LE(last_of(run, "pressure_residual"), linear);
  EXPECT_GT(last_of(run, "pressure_residual"), 0);
  const CellValues error = run.field("volume_error");
  const double largest = std::max(highest(error), -lowest(error));
  EXPECT_EQ(last_of(run, "largest_volume_error"), largest);
  EXPECT_LE(largest, outer);
}

}  // namespace
}  // namespace sluice::verification::step_labels_test
