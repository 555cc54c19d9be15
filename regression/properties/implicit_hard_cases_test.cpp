// Semi-implicit runs that are cut, and solves that cannot do what the deck asks of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/loading/sluice_schema.hpp"
#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"
#include "properties/shell_run.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties::implicit_hard_cases_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// --- restart between any two steps ---

class ImplicitRestart : public testing::TestWithParam<const char*> {};

TEST_P(ImplicitRestart, BetweenAnyTwoStepsGivesTheSameBits) {
  ScratchFolder scratch;
  DeckRun run;
  run.deck = GetParam() + std::string(every_step_suffix);
  run.folder = scratch / "whole";
  const fs::path reference = carry_out(run).archive.value();
  const std::vector<StepEntry> checkpoints = Archive::open(reference).checkpoints();
  ASSERT_GT(checkpoints.size(), 8u);
  run.restart = reference;
  run.split = {3, 2, 1};
  for (std::size_t n = 0; n + 1 < checkpoints.size(); ++n) {
    SCOPED_TRACE("from step " + std::to_string(checkpoints[n].step));
    run.restart_step = checkpoints[n].step;
    run.folder = scratch / ("from " + std::to_string(run.restart_step));
    const fs::path rest = carry_out(run).archive.value();
    EXPECT_EQ(difference(reference, rest, false, true), "") << "in the outputs";
    EXPECT_EQ(difference(reference, rest, true, true), "") << "in the checkpoints";
    EXPECT_EQ(Archive::open(rest).checkpoints().back().step, checkpoints.back().step);
  }
}

INSTANTIATE_TEST_SUITE_P(Decks, ImplicitRestart,
                         testing::Values("implicit_pulse", "implicit_water_air"),
                         [](const auto& test) { return std::string(test.param); });
INSTANTIATE_TEST_SUITE_P(Full, ImplicitRestart,
                         testing::Values("implicit_cavity", "implicit_convection", "implicit_dam",
                                         "implicit_sloshing", "implicit_layers_at_rest",
                                         "amr_implicit_blob", "amr_implicit_pulse",
                                         "amr_implicit_layers_at_rest"),
                         [](const auto& test) { return std::string(test.param); });

// --- SIGTERM inside a solve ---

// Nearly all of such a step is the solve, by a solver that takes hundreds of iterations.
const std::string slow_solves =
    SLUICE_COMMAND " run " SLUICE_SOURCE_DIR
                   "/inputs/ice/implicit_cavity.ups --progress none --json run.json"
                   " --set 'Grid/Level/Box/resolution=[48,48,1]' --set Time/max_Timesteps=12"
                   " --set DataArchiver/outputTimestepInterval=2 --set DataArchiver/outputInterval="
                   " --set DataArchiver/checkpoint/@timestepInterval=2"
                   " --set CFD/ICE/ImplicitSolver/Parameters/solver=cg"
                   " --set CFD/ICE/ImplicitSolver/Parameters/preconditioner=none"
                   " --set CFD/ICE/ImplicitSolver/Parameters/maxiterations=5000"
                   " --set CFD/ICE/ImplicitSolver/Parameters/tolerance=1e-11"
                   " --set Solver/@type=hypre";

TEST(ImplicitSigterm, InsideASolveEndsWithACheckpointAndARestartGivesTheSameBits) {
  ScratchFolder scratch;
  const fs::path whole = scratch / "whole";
  ProcessRequest request = shell(whole, slow_solves);
  ASSERT_EQ(run_process(request), 0) << last_lines(request.output, 10);
  const fs::path folder = scratch / "cut";
  fs::create_directories(folder / "rest");
  request = shell(folder, slow_solves +
                              " &\npid=$!\nuntil [ -e implicit_cavity.uda/t00004/timestep.xml ] ||"
                              " ! kill -0 $pid; do sleep 0.003; done\n"
                              "sleep 0.01; kill -TERM $pid; wait $pid");
  const int status = run_process(request);
  ASSERT_EQ(status, 4) << last_lines(request.output, 10);
  const nlohmann::json run = record(folder / "run.json");
  EXPECT_EQ(run["status"], "terminated");
  EXPECT_LT(run["steps"], 12);
  const Archive archive = Archive::open(folder / "implicit_cavity.uda");
  EXPECT_EQ(archive.checkpoints().back().step, run["steps"]);
  request =
      shell(folder, SLUICE_COMMAND " run --restart implicit_cavity.uda -o rest --progress none");
  ASSERT_EQ(run_process(request), 0) << last_lines(request.output, 10);
  const fs::path rest = folder / "rest" / "implicit_cavity.uda";
  EXPECT_EQ(difference(whole / "implicit_cavity.uda", rest, false, true), "");
  EXPECT_EQ(Archive::open(rest).outputs().back().step, 12);
}

// --- what no solve can do ---

RunReport run_cavity(const std::vector<std::string>& more, int steps) {
  std::vector<std::string> overrides{"Grid/Level/Box/resolution=[12,12,1]"};
  for (const std::string& one : more) overrides.push_back("CFD/ICE/ImplicitSolver/" + one);
  overrides.push_back("Time/max_Timesteps=" + std::to_string(steps));
  const Deck deck =
      load_deck(SLUICE_SOURCE_DIR "/inputs/ice/implicit_cavity.ups", overrides, sluice_schema());
  return carry_out(deck, fs::path{});
}

// One iteration a pass: passes go on until the volume error is small, or the step is redone.
TEST(ImplicitLimits, OneIterationAPassConvergesByMorePasses) {
  const RunReport report = run_cavity(
      {"Parameters/maxiterations=1", "max_outer_iterations=100", "outer_iteration_tolerance=1e-8"},
      10);
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, 10);
}

TEST(ImplicitLimits, OneIterationAndOnePassStillKeepTheBalances) {
  const RunReport report = run_cavity({"Parameters/maxiterations=1", "max_outer_iterations=1"}, 10);
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, 10);
  const auto totals = nlohmann::json::parse(report.conservation_json);
  for (const auto& [name, total] : totals.items()) {
    if (!name.starts_with("mass") && name != "total energy") continue;
    const double lost = std::abs(total.at("defect").get<double>());
    EXPECT_LE(lost, 1e-13 * total.at("scale").get<double>()) << name;
  }
}

TEST(ImplicitLimits, ToleranceZeroEndsAtRoundOff) {
  const RunReport report =
      run_cavity({"Parameters/tolerance=0", "max_outer_iterations=20",
                  "outer_iteration_tolerance=0", "iters_before_timestep_restart=20"},
                 5);
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, 5);
}

// A step that cannot converge is redone smaller, in vain: the run says so, with the history.
TEST(ImplicitLimits, NoConvergenceIsToldWithTheHistoryOfThePasses) {
  std::string said;
  try {
    said = run_cavity({"Parameters/maxiterations=1", "max_outer_iterations=2",
                       "outer_iteration_tolerance=1e-30"},
                      5)
               .message;
  } catch (const std::exception& error) {
    said = error.what();
  }
  EXPECT_THAT(said, HasSubstr("the pressure did not converge"));
  EXPECT_THAT(said, HasSubstr("1: "));
  EXPECT_THAT(said, HasSubstr("2: "));
  EXPECT_THAT(said, HasSubstr("iterations to"));
  EXPECT_THAT(said, HasSubstr("<outer_iteration_tolerance>"));
}

// All sides closed and sound so swift that rows nearly sum to 0: singular to round-off.
TEST(ImplicitLimits, NearlySingularBoxGoesOn) {
  const Deck deck =
      load_deck(SLUICE_SOURCE_DIR "/inputs/ice/implicit_cavity.ups",
                {"Grid/Level/Box/resolution=[12,12,1]", "Time/max_Timesteps=10",
                 "MaterialProperties/ICE/material/geom_object/pressure=7.142857142857143e11",
                 "MaterialProperties/ICE/material/geom_object/temperature=1.7857142857142855e12"},
                sluice_schema());
  const RunReport report = carry_out(deck, fs::path{});
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, 10);
}

// No fluid flows through any face: one cell with walls all around.
TEST(ImplicitLimits, OneCellBetweenWallsStaysAsItIs) {
  const Deck deck =
      load_deck(SLUICE_SOURCE_DIR "/inputs/ice/implicit_pulse.ups",
                {"Grid/Level/Box/resolution=[1,1,1]", "Time/max_Timesteps=10"}, sluice_schema());
  const RunReport report = carry_out(deck, fs::path{});
  EXPECT_EQ(report.message, "");
  EXPECT_EQ(report.steps, 10);
}

}  // namespace
}  // namespace sluice::properties::implicit_hard_cases_test
