// Which lines levels.txt gets, and what a restart takes over.
#include "framework/run/simulation/level_history.hpp"

#include <gtest/gtest.h>

#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::level_history_test {
namespace {

namespace fs = std::filesystem;

class LevelHistoryTest : public testing::Test {
 protected:
  std::string written(const char* sub) const { return read_text(folder_ / sub / "levels.txt"); }
  fs::path sub(const char* name) const {
    fs::create_directories(folder_ / name);
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

const std::string two_levels = "# step\ttime\tlevel 0\tlevel 1\n";

TEST_F(LevelHistoryTest, HasALineForEveryChangeAndOneForTheEnd) {
  LevelHistory history(2, true);
  history.open(sub("a"));
  history.sample(0, 0, {100, 0});
  history.sample(1, 0.25, {100, 0});
  history.sample(2, 0.5, {100, 64});
  history.flush();
  EXPECT_EQ(written("a"), two_levels + "0\t0\t100\t0\n2\t0.5\t100\t64\n");
  history.sample(3, 0.75, {100, 64});
  history.finish();
  EXPECT_EQ(written("a"), two_levels + "0\t0\t100\t0\n2\t0.5\t100\t64\n3\t0.75\t100\t64\n");
}

TEST_F(LevelHistoryTest, AChangeInTheLastStepIsTheEnd) {
  LevelHistory history(2, true);
  history.open(sub("a"));
  history.sample(7, 0.5, {100, 8});
  history.finish();
  EXPECT_EQ(written("a"), two_levels + "7\t0.5\t100\t8\n");
}

TEST_F(LevelHistoryTest, ARestartTakesOverTheLinesUpToItsTime) {
  LevelHistory first(2, true);
  first.open(sub("a"));
  first.sample(0, 0, {100, 8});
  first.sample(4, 0.5, {100, 16});
  first.sample(6, 0.75, {100, 32});
  first.finish();
  LevelHistory second(2, true);
  second.open(sub("b"));
  second.adopt(folder_ / "a", 0.5);
  second.sample(4, 0.5, {100, 16});  // as the last line says
  second.sample(5, 0.625, {100, 24});
  second.finish();
  EXPECT_EQ(written("b"), two_levels + "0\t0\t100\t8\n4\t0.5\t100\t16\n5\t0.625\t100\t24\n");
}

TEST_F(LevelHistoryTest, OneLevelOtherRanksAndRunsWithoutAnArchiveWriteNothing) {
  for (const auto& [levels, is_root] : {std::pair{1, true}, std::pair{2, false}}) {
    LevelHistory history(levels, is_root);
    history.open(sub("a"));
    history.sample(0, 0, std::vector<std::int64_t>(levels, 8));
    history.finish();
    EXPECT_FALSE(fs::exists(folder_ / "a" / "levels.txt"));
  }
  LevelHistory nowhere(2, true);
  nowhere.sample(0, 0, {100, 8});
  nowhere.finish();
  EXPECT_TRUE(fs::is_empty(folder_ / "a"));
}

}  // namespace
}  // namespace sluice::level_history_test
