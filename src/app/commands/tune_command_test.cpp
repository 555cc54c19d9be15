// sluice tune as a user meets it: a deck whose own solver fails gets one that does not, and the
// tuned copy gives the solution of any other solver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::app::tune_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class TuneCommand : public testing::Test {
 protected:
  static std::string ours(const std::string& name) {
    return std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/" + name + ".ups";
  }
  int sluice(const std::vector<std::string>& words) {
    const Outcome outcome = run_sluice(words);
    said_ = outcome.text;
    return outcome.status;
  }
  // A heated square of 16 x 16 cells with a long step, to be solved to 1e-9 in 20 iterations:
  // Jacobi's do not get there, those with multigrid do.
  std::string weak_deck() {
    std::string text = text_of(ours("implicit_natural_convection"));
    const auto replace = [&](const std::string& old, const std::string& by) {
      const std::size_t at = text.find(old);
      ASSERT_NE(at, std::string::npos) << old;
      text.replace(at, old.size(), by);
    };
    replace("<Time>", "<Solver type=\"hypre\"/>  <!-- weak -->\n  <Time>");
    replace("<tolerance>1e-4</tolerance>",
            "<solver> jacobi </solver> <maxiterations>20</maxiterations>\n"
            "          <tolerance>1e-9</tolerance>");
    replace("<max_delt_increase>0.25<", "<max_delt_increase>1000<");
    const std::string file = (folder_ / "weak.ups").string();
    std::ofstream(file) << text;
    return file;
  }
  std::string run(const std::string& deck, const std::string& name) {
    const std::string parent = (folder_ / name).string();
    fs::create_directories(parent);
    const int status =
        sluice({"run", deck, "-o", parent, "--max-steps", "8", "--progress", "none"});
    EXPECT_TRUE(status == 0 || status == 4) << said_;
    return parent + "/implicit_natural_convection.uda";
  }

  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  std::string said_;
};

TEST_F(TuneCommand, FindsASolverWritesItAndTellsAll) {
  const std::string deck = weak_deck(), tuned = (folder_ / "tuned.ups").string(),
                    numbers = (folder_ / "tune.json").string();
  ASSERT_EQ(sluice({"tune", deck, "--steps", "4", "--systems", "2", "--budget", "20", "--apply",
                    tuned, "--json", numbers}),
            0)
      << said_;
  for (const char* part : {"256 unknowns on 1 level", "of the first 4 steps", "hypre jacobi *",
                           "the maximum of iterations", "iterations", "memory",
                           "the deck's own solver fails", "<Solver type=", "tuned deck: "})
    EXPECT_THAT(said_, HasSubstr(part));
  const json told = json::parse(text_of(numbers));
  EXPECT_EQ(told.at("deck_solver"), "hypre jacobi");
  EXPECT_EQ(told.at("systems").back().at("number"), 4);
  EXPECT_TRUE(told.at("change").get<bool>());
  for (const json& solver : told.at("solvers")) {
    if (solver.at("state") != "ranked") continue;
    EXPECT_GT(solver.at("seconds").get<double>(), 0.0);
    for (const json& trial : solver.at("systems_last_first"))
      EXPECT_LE(trial.at("residual_over_goal").get<double>(), 1.000001) << solver.dump();
  }

  const std::string written = text_of(tuned);
  EXPECT_THAT(written, HasSubstr("<!-- weak -->\n  <Time>"));
  EXPECT_THAT(said_, HasSubstr(told.at("xml").get<std::string>()));
}

// The tuned copy solves the same problem: to the tolerance, the solution of our own solver.
// Which solver is the best depends on the machine, so that its solution is another within the
// deck's tolerance: that the copy runs is all that can be asked here.
TEST_F(TuneCommand, TheTunedCopyRuns) {
  const std::string deck = weak_deck(), tuned = (folder_ / "tuned.ups").string();
  ASSERT_EQ(
      sluice({"tune", deck, "--steps", "2", "--systems", "1", "--budget", "20", "--apply", tuned}),
      0)
      << said_;
  EXPECT_FALSE(run(tuned, "tuned").empty());
}

TEST_F(TuneCommand, JsonAloneOnStandardOutput) {
  ASSERT_EQ(sluice({"tune", ours("implicit_natural_convection"), "--steps", "2", "--budget", "20",
                    "--json", "-"}),
            0)
      << said_;
  const json told = json::parse(said_);
  EXPECT_EQ(told.at("deck_solver"), "CGSolver");
  EXPECT_EQ(told.at("solvers").at(0).at("state"), "ranked");
}

// The first step of this deck is tiny, so that its solves are nearly done before they begin.
TEST_F(TuneCommand, SaysWhereSolvesAreTooEasy) {
  const std::vector<std::string> words = {
      "tune",  ours("implicit_cavity"), "--steps", "2", "--budget", "20",
      "--set", "Time/delt_init=1e-7",   "--json",  "-"};
  ASSERT_EQ(sluice(words), 0) << said_;
  EXPECT_TRUE(json::parse(said_).at("two_iterations_or_fewer").get<bool>());
  ASSERT_EQ(sluice({words.begin(), words.end() - 2}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("two iterations or fewer"));
}

// Without --steps as many as a third of the budget allows, or as the deck has.
TEST_F(TuneCommand, SamplesOverTheWholeRun) {
  ASSERT_EQ(sluice({"tune", ours("implicit_natural_convection"), "--set", "Time/max_Timesteps=40",
                    "--budget", "20", "--json", "-"}),
            0)
      << said_;
  const json told = json::parse(said_);
  EXPECT_EQ(told.at("steps"), 40);
  ASSERT_EQ(told.at("systems").size(), 3U);
  EXPECT_NEAR(told.at("systems")[0].at("number").get<double>(), 40 / 3.0, 5);
  EXPECT_NEAR(told.at("systems")[1].at("number").get<double>(), 80 / 3.0, 5);
  EXPECT_EQ(told.at("systems")[2].at("number"), 40);
}

TEST_F(TuneCommand, GoesOnFromACheckpoint) {
  const std::string archive = run(ours("implicit_natural_convection"), "early");
  ASSERT_EQ(sluice({"tune", "--restart", archive, "--steps", "3", "--systems", "2", "--budget",
                    "20", "--quiet", "--json", "-"}),
            0)
      << said_;
  const json told = json::parse(said_);
  EXPECT_EQ(told.at("first_step"), 8);
  EXPECT_EQ(told.at("steps"), 3);
  EXPECT_EQ(told.at("systems").back().at("number"), 3);
  ASSERT_EQ(sluice({"tune", "--restart", archive, "--steps", "1", "--budget", "20"}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("of the first 1 step after step 8"));
  EXPECT_EQ(sluice({"tune", "--restart", archive, "--step", "7"}), 2);
  EXPECT_THAT(said_, HasSubstr("has no checkpoint of step 7"));
  EXPECT_EQ(sluice({"tune"}), 2);
  EXPECT_EQ(sluice({"tune", ours("implicit_cavity"), "--step", "7"}), 2);
}

TEST_F(TuneCommand, LevelsAreTunedToo) {
  ASSERT_EQ(sluice({"tune", ours("amr_implicit_blob"), "--steps", "2", "--budget", "20"}), 0)
      << said_;
  EXPECT_THAT(said_, HasSubstr("on 2 levels"));
}

TEST_F(TuneCommand, WhatCannotBeTunedIsRefused) {
  EXPECT_EQ(sluice({"tune", ours("shock_tube")}), 2);
  EXPECT_THAT(said_, HasSubstr("solves no linear system"));
  EXPECT_EQ(sluice({"tune", ours("implicit_cavity"), "--budget", "0"}), 2);
  EXPECT_THAT(said_, HasSubstr("--budget is 0"));
  EXPECT_EQ(sluice({"tune", ours("implicit_cavity"), "--apply", ours("implicit_cavity")}), 2);
  EXPECT_THAT(said_, HasSubstr("a name of its own"));
}

}  // namespace
}  // namespace sluice::app::tune_command_test
