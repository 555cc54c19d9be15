// Runs on levels that are cut: a restart from every checkpoint, on other ranks and boxes, also
// right after a regrid; SIGTERM at any moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "properties/deck_run.hpp"
#include "properties/shell_run.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties::amr_restart_test {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const std::string every_step(every_step_suffix);

fs::path archive_in(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_symlink()) return entry.path();
  return {};
}

// Cells of each level at each checkpoint.
std::vector<std::vector<std::int64_t>> hierarchies(const fs::path& folder) {
  const Archive archive = Archive::open(folder);
  std::vector<std::vector<std::int64_t>> all;
  for (const StepEntry& e : archive.checkpoints()) {
    const ArchiveStep step = archive.read_checkpoint(e);
    all.emplace_back();
    for (const Level& level : step.grid().levels) all.back().push_back(level.cell_count());
  }
  return all;
}

class EveryCheckpoint : public testing::TestWithParam<const char*> {
 protected:
  DeckRun run_into(const std::string& folder) const {
    DeckRun run;
    run.deck = GetParam() + every_step;
    run.folder = scratch_ / folder;
    return run;
  }
  // Restarts from every checkpoint but the last (or from those that a regrid came before), by
  // `carry_all`; all end alike.
  template <class F>
  void expect_equal_ends(DeckRun how, bool after_regrids, F&& carry_all) const {
    const fs::path reference = carry_out(run_into("whole")).archive.value();
    std::vector<DeckRun> runs;
    const std::vector<StepEntry> checkpoints = Archive::open(reference).checkpoints();
    ASSERT_GT(checkpoints.size(), 8u);
    const auto cells = hierarchies(reference);
    EXPECT_GT(std::set(cells.begin(), cells.end()).size(), 1u) << "no regrid";
    for (std::size_t n = 0; n + 1 < checkpoints.size(); ++n) {
      if (after_regrids && n > 0 && cells[n] == cells[n - 1]) continue;
      how.restart = reference;
      how.restart_step = checkpoints[n].step;
      how.folder = scratch_ / ("from " + std::to_string(checkpoints[n].step));
      runs.push_back(how);
    }
    carry_all(runs);
    for (const DeckRun& run : runs) {
      SCOPED_TRACE("from step " + std::to_string(run.restart_step));
      const fs::path rest = archive_in(run.folder);
      ASSERT_FALSE(rest.empty());
      EXPECT_EQ(difference(reference, rest, false, true), "") << "in the outputs";
      EXPECT_EQ(difference(reference, rest, true, true), "") << "in the checkpoints";
      EXPECT_EQ(Archive::open(rest).checkpoints().back().step, checkpoints.back().step);
    }
  }
  ScratchFolder scratch_;
};

TEST_P(EveryCheckpoint, GoesOnTheSameWayOnOtherBoxes) {
  DeckRun how = run_into("unused");
  how.split = {3, 2, 1};
  how.box_cells = 50;
  expect_equal_ends(how, false, [](const std::vector<DeckRun>& runs) {
    for (const DeckRun& run : runs) carry_out(run);
  });
}

// In ./dev test KindsOnTwoRanks and RestartAfterARegrid stand for it.
TEST_P(EveryCheckpoint, FullGoesOnTheSameWayOnTwoRanks) {
  expect_equal_ends(run_into("unused"), true, [](const std::vector<DeckRun>& runs) {
    EXPECT_EQ(carry_out_on_ranks(runs, 2), "");
  });
}

const auto name_of_deck = [](const auto& test) { return std::string(test.param); };
INSTANTIATE_TEST_SUITE_P(Decks, EveryCheckpoint, testing::Values("amr_shock_tube"), name_of_deck);
INSTANTIATE_TEST_SUITE_P(Full, EveryCheckpoint,
                         testing::Values("amr_periodic_shocks", "amr_mass_exchange_heat",
                                         "amr_explosion", "amr_explosion_greedy",
                                         "amr_explosion_lockstep", "amr_water_square",
                                         "amr_water_cylinder", "amr_water_cylinder_greedy"),
                         name_of_deck);

// A run of several ranks goes on on one.
void expect_a_restart_on_fewer_ranks(const std::string& deck, int ranks, int most_restarts) {
  ScratchFolder scratch;
  DeckRun run;
  run.deck = deck + every_step;
  run.folder = scratch / "whole";
  const fs::path reference = carry_out(run).archive.value();
  run.folder = scratch / "ranks";
  ASSERT_EQ(carry_out_on_ranks({run}, ranks), "");
  run.restart = archive_in(run.folder);
  const auto cells = hierarchies(reference);
  ASSERT_EQ(hierarchies(run.restart), cells);
  int restarts = 0;
  for (std::size_t n = 1; n + 1 < cells.size() && restarts < most_restarts; ++n) {
    if (cells[n] == cells[n - 1]) continue;
    ++restarts;
    run.restart_step = Archive::open(reference).checkpoints()[n].step;
    run.folder = scratch / ("from " + std::to_string(run.restart_step));
    const fs::path rest = carry_out(run).archive.value();
    EXPECT_EQ(difference(reference, rest, false, true), "");
    EXPECT_EQ(difference(reference, rest, true, true), "");
  }
  EXPECT_GT(restarts, 0);
}

TEST(RestartAfterARegrid, OnFewerRanks) {
  expect_a_restart_on_fewer_ranks("amr_shock_tube", 2, 2);
}

TEST(FullRestartAfterARegrid, OnFewerRanks) {
  expect_a_restart_on_fewer_ranks("amr_shock_tube", 2, 1000);
  expect_a_restart_on_fewer_ranks("amr_explosion", 4, 1000);
}

// By the command itself, soon after these outputs, at moments that are not chosen: between whatever
// substeps. Of every other one the run goes on on two ranks.
void expect_the_same_bits_after_sigterm(std::initializer_list<int> outputs) {
  ScratchFolder scratch;
  const std::string run = SLUICE_COMMAND
      " run " SLUICE_SOURCE_DIR
      "/inputs/ice/amr_explosion.ups --progress none --json run.json"
      " --set 'Grid/Level/Box/resolution=[40,40,1]' --set DataArchiver/outputTimestepInterval=10"
      " --set DataArchiver/checkpoint/@timestepInterval=10 --set Time/max_Timesteps=60"
      " --set Time/maxTime=1000";
  const fs::path whole = scratch / "whole";
  ProcessRequest request = shell(whole, run);
  ASSERT_EQ(run_process(request), 0) << last_lines(request.output, 10);
  int cut = 0;
  for (const int output : outputs) {
    const fs::path folder = scratch / ("cut " + std::to_string(output));
    fs::create_directories(folder / "rest");
    const std::string file = "amr_explosion.uda/t000" + std::to_string(output) + "/timestep.xml";
    request = shell(folder, run + " &\npid=$!\nuntil [ -e " + file +
                                " ] || ! kill -0 $pid; do sleep 0.003; done\n"
                                "kill -TERM $pid; wait $pid");
    const int status = run_process(request);
    const bool cut_short = record(folder / "run.json")["status"] == "terminated";
    ASSERT_EQ(status, cut_short ? 4 : 0) << last_lines(request.output, 10);
    if (!cut_short) continue;  // it was at its end
    ++cut;
    const Archive archive = Archive::open(folder / "amr_explosion.uda");
    EXPECT_EQ(archive.checkpoints().back().step, record(folder / "run.json")["steps"]);
    const std::string ranks = output % 20 == 0 ? SLUICE_MPIEXEC " --oversubscribe -np 2 " : "";
    request = shell(
        folder, ranks + SLUICE_COMMAND " run --restart amr_explosion.uda -o rest --progress none");
    ASSERT_EQ(run_process(request), 0) << last_lines(request.output, 10);
    const fs::path rest = folder / "rest" / "amr_explosion.uda";
    EXPECT_EQ(difference(whole / "amr_explosion.uda", rest, false, true), "");
    EXPECT_EQ(Archive::open(rest).outputs().back().step, 60);
  }
  EXPECT_GT(cut, 0);
}

TEST(Sigterm, AnywhereEndsWithACheckpointAndARestartGivesTheSameBits) {
  expect_the_same_bits_after_sigterm({10});
}

TEST(FullSigterm, AnywhereEndsWithACheckpointAndARestartGivesTheSameBits) {
  expect_the_same_bits_after_sigterm({10, 20, 30, 40, 50});
}

}  // namespace
}  // namespace sluice::properties::amr_restart_test
