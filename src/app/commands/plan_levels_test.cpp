// sluice plan and the end of sluice run about levels: what is planned is what the run has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::plan_levels_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class PlanLevels : public testing::Test {
 protected:
  static std::string deck(const std::string& name) {
    return std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/" + name + ".ups";
  }
  std::string sluice(const std::string& command, const std::string& name,
                     std::vector<std::string> options = {}) {
    options.insert(options.begin(), {command, deck(name), "--quiet"});
    const Outcome outcome = run_sluice(options);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return outcome.text;
  }
  Outcome run_here(std::vector<std::string> words) {
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"-o", folder_.string(), "--progress", "none"});
    return run_sluice(words);
  }
  json plan(const std::string& name, std::vector<std::string> options = {}) {
    options.emplace_back("--json");
    return json::parse(sluice("plan", name, options));
  }
  json run(const std::string& name, std::vector<std::string> options = {}) {
    options.insert(options.end(), {"-o", folder_.string(), "--progress", "none", "--json",
                                   (folder_ / "run.json").string()});
    sluice("run", name, options);
    return json::parse(text_of(folder_ / "run.json"));
  }

  TemporaryFolder folder_{TemporaryFolder::Place::disk};
};

// One process plans for several ranks: levels that stay, and levels that move.
TEST_F(PlanLevels, AreTheSameForSeveralRanks) {
  for (const char* name : {"amr_explosion", "amr_shock_tube", "amr_water_square"}) {
    const json one = plan(name), three = plan(name, {"--ranks", "3"});
    EXPECT_EQ(three.at("ranks"), 3);
    EXPECT_GT(three.at("messages").at("bytes_per_step"), 0) << name;
    EXPECT_EQ(three.at("time_step"), one.at("time_step")) << name;
    for (std::size_t l = 0; l < one.at("hierarchy").at("levels").size(); ++l)
      EXPECT_EQ(three.at("hierarchy").at("levels").at(l).at("cells"),
                one.at("hierarchy").at("levels").at(l).at("cells"))
          << name;
  }
}

TEST_F(PlanLevels, AreThoseThatTheRunBeginsWith) {
  const json planned = plan("amr_explosion");
  const json ran = run("amr_explosion", {"--max-steps", "1"});
  std::istringstream lines(text_of(folder_ / "amr_explosion.uda.000/levels.txt"));
  std::string header;
  std::getline(lines, header);
  EXPECT_EQ(header, "# step\ttime\tlevel 0\tlevel 1\tlevel 2");
  double step = -1, time = -1;
  std::int64_t cells[3] = {};
  lines >> step >> time >> cells[0] >> cells[1] >> cells[2];
  EXPECT_EQ(step, 0);
  const json& levels = planned.at("hierarchy").at("levels");
  ASSERT_EQ(levels.size(), 3u);
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_EQ(levels[l].at("cells"), cells[l]);
    EXPECT_EQ(levels[l].at("substeps"), ran.at("levels").at(l).at("substeps"));
    EXPECT_EQ(levels[l].at("domain_cells"), ran.at("levels").at(l).at("domain_cells"));
  }
  EXPECT_EQ(planned.at("cells"), cells[0] + cells[1] + cells[2]);
  EXPECT_EQ(planned.at("hierarchy").at("updates_per_coarse_step"), ran.at("cell_updates"));
  EXPECT_EQ(planned.at("hierarchy").at("uniform_updates"), ran.at("uniform_updates"));
  EXPECT_EQ(planned.at("time_step").at("first_step"), ran.at("time"));
}

TEST_F(PlanLevels, AreToldWithWhatDecidesThem) {
  const std::string said = sluice("plan", "amr_explosion");
  for (const char* part : {"W-cycle", "gradient of rho_CC", "above 0.5, material 0",
                           "amr_explosion.ups:", "that a uniform fine grid needs",
                           "level 2 finer level, 2 substeps", "matched", "8,8,1"})
    EXPECT_THAT(said, HasSubstr(part));
  EXPECT_THAT(sluice("plan", "shock_tube"), Not(HasSubstr("W-cycle")));
  const std::string drop = sluice("plan", "amr_followed_drop");
  for (const char* part : {"interfaces of material 0", "within 0.06, up to level 1",
                           "within 0.02, up to level 2", "amr_followed_drop.ups:44"})
    EXPECT_THAT(drop, HasSubstr(part));
}

TEST_F(PlanLevels, LockstepTakesOneSubstep) {
  const json p = plan("amr_explosion", {"--set", "AMR/useLockStep=true"});
  EXPECT_THAT(p.at("hierarchy").at("stepping").get<std::string>(), HasSubstr("lockstep"));
  const std::string crossed = "the distance that a wave travels in a coarse step";
  EXPECT_THAT(p.dump(), Not(HasSubstr(crossed)));
  EXPECT_THAT(plan("amr_explosion").dump(), HasSubstr(crossed));
  for (const json& level : p.at("hierarchy").at("levels")) EXPECT_EQ(level.at("substeps"), 1);
}

TEST_F(PlanLevels, SayThatOnlyTheClassicSchemeMayLeaveFluxesUnequal) {
  const std::string off = "AMR/ICE/do_Refluxing=false";
  EXPECT_THAT(sluice("plan", "amr_explosion", {"--set", off}),
              HasSubstr("do_Refluxing false has no effect, only the classic scheme obeys it"));
  EXPECT_THAT(sluice("plan", "amr_explosion", {"--set", off, "--set", "CFD/ICE/scheme=classic"}),
              HasSubstr("not matched"));
}

TEST_F(PlanLevels, OfALargeDeckAreNotSetJustToBeSeen) {
  const json p = plan("amr_explosion", {"--set", "Grid/Level/Box/resolution=[4000,4000,1]"});
  EXPECT_TRUE(p.at("hierarchy").at("levels").at(1).at("cells").is_null());
  EXPECT_EQ(p.at("hierarchy").at("levels").at(0).at("cells"), 16'000'000);
  EXPECT_TRUE(p.at("time_step").at("first_step").is_null());
}

TEST_F(PlanLevels, TakeTheMemoryThatWasPlanned) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  const std::string size = "Grid/Level/Box/resolution=[512,512,1]";
  const json planned = plan("amr_explosion", {"--set", size, "--no-output"});
  const json ran = run("amr_explosion", {"--set", size, "--no-output", "--max-steps", "2"});
  const double measured = ran.at("peak_memory_bytes").get<double>();
  // Planned and measured: 6.65e7 and 6.27e7.
  EXPECT_NEAR(planned.at("memory").at("peak_bytes").get<double>(), measured, 0.1 * measured);
}

// The link to the newest archive moves to the one that the restart makes.
TEST_F(PlanLevels, ARestartThroughTheLinkGoesOnWithTheLevelsOverTime) {
  std::string deck_text = text_of(deck("amr_shock_tube"));
  const std::string end = "</DataArchiver>";
  deck_text.insert(deck_text.find(end), "<checkpoint cycle=\"0\" timestepInterval=\"5\"/>");
  std::ofstream(folder_ / "tube.ups") << deck_text;
  const auto go = [&](const std::vector<std::string>& words) {
    const Outcome outcome = run_here(words);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
  };
  const std::string tube = (folder_ / "tube.ups").string();
  go({tube, "--max-steps", "14"});
  go({"--restart", (folder_ / "amr_shock_tube.uda").string()});
  go({tube});
  EXPECT_EQ(text_of(folder_ / "amr_shock_tube.uda.001/levels.txt"),
            text_of(folder_ / "amr_shock_tube.uda.002/levels.txt"));
  EXPECT_THAT(text_of(folder_ / "amr_shock_tube.uda.002/levels.txt"), HasSubstr("\n56\t0.2"));
}

// Tiles in the corner are there with every ratio and tile size, but hold other cells.
TEST_F(PlanLevels, ARestartWithOtherRatiosOrTilesIsRefusedByName) {
  const Outcome first =
      run_here({deck("amr_regions"), "--max-steps", "2", "--set",
                "DataArchiver/checkpoint/@timestepInterval=1", "--set", "AMR/Refine[2]=", "--set",
                "AMR/Refine/geom_object/box/min=[-1,-1,-1]", "--set",
                "AMR/Refine/geom_object/box/max=[-0.6,-0.6,1]", "--set", "AMR/Refine/@level=1"});
  ASSERT_EQ(first.status, 0) << first.text;
  const std::string archive = (folder_ / "amr_regions.uda").string();
  const auto restart_with = [&](const std::string& tag) {
    const Outcome outcome = run_here({"--restart", archive, "--set", "AMR/Regridder/" + tag});
    EXPECT_EQ(outcome.status, 2) << tag;
    return outcome.text;
  };
  EXPECT_THAT(restart_with("cell_refinement_ratio=[[4,4,1]]"),
              HasSubstr("contains a grid of [128, 128, 1] cells on level 1"));
  EXPECT_THAT(restart_with("min_patch_size=[[4,4,1]]"),
              HasSubstr("contains 1024 cells on level 1, where this deck has 256"));
}

TEST_F(PlanLevels, ARunTellsWhatItsLevelsSaved) {
  const std::string said = sluice("run", "amr_shock_tube", {"-o", folder_.string()});
  for (const char* part : {"level 2: ", "that a uniform fine grid needs", "of the stepping time"})
    EXPECT_THAT(said, HasSubstr(part));
  const json ran = run("amr_shock_tube");
  EXPECT_LT(ran.at("cell_updates").get<double>(), ran.at("uniform_updates").get<double>());
  EXPECT_GT(ran.at("regrids").get<int>(), 0);
  EXPECT_GE(ran.at("levels").at(2).at("most_cells"), ran.at("levels").at(2).at("cells"));
}

}  // namespace
}  // namespace sluice::plan_levels_test
