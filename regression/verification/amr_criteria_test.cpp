// What asks for finer levels: the estimated error against the uniform grid, regions of the deck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "verification/amr_case.hpp"

namespace sluice::verification {
namespace {

TEST(AmrCriteria, TheErrorCriterionIsAsGoodAsTheUniformFineGrid) {
  constexpr double allowed_loss = 1.05;   // density 1.014
  constexpr double allowed_share = 0.22;  // of cell updates, 0.19
  const CaseRun adaptive("amr_explosion_error");
  const CaseRun uniform("amr_explosion_error", {one_level(), resolution(512, 512)},
                        {"--threads", "2"});
  const double loss = adaptive.error("rho_CC").l1 / uniform.error("rho_CC").l1;
  record("rho_CC_by_uniform", loss);
  record("share_of_updates", share_of_uniform(adaptive));
  EXPECT_LE(loss, allowed_loss);
  EXPECT_LT(share_of_uniform(adaptive), allowed_share);
  EXPECT_GT(most_cells(adaptive).back(), 0);
}

TEST(AmrCriteria, AWiderToleranceCostsLessAndErrsMore) {
  const auto with = [](const char* tolerance) {
    return CaseRun(
        "amr_explosion_error",
        {"AMR/Regridder/max_levels=3", "AMR/ErrorEstimate/@tolerance=" + std::string(tolerance)});
  };
  const CaseRun strict = with("0.01"), loose = with("0.04");
  EXPECT_LT(share_of_uniform(loose), 0.8 * share_of_uniform(strict));
  EXPECT_GT(loose.error("rho_CC").l1, strict.error("rho_CC").l1);
}

// In an order that no box decides.
std::vector<LevelCell> sorted_cells(const CaseRun& run) {
  std::vector<LevelCell> cells = level_cells(run, "rho_CC");
  std::sort(cells.begin(), cells.end(), [](const LevelCell& a, const LevelCell& b) {
    return std::tie(a.level, a.cell.z, a.cell.y, a.cell.x) <
           std::tie(b.level, b.cell.z, b.cell.y, b.cell.x);
  });
  return cells;
}

// The range of the variable is the same whoever holds the cells.
TEST(AmrCriteria, RanksAndThreadsDoNotShowInErrors) {
  const std::vector<std::string> small = {resolution(32, 32), "Time/maxTime=0.1"};
  const CaseRun one("amr_explosion_error", small);
  const std::vector<LevelCell> wanted = sorted_cells(one);
  EXPECT_GT(wanted.back().level, 1);
  for (const int ranks : {1, 3}) {
    const CaseRun run("amr_explosion_error", small, {"--threads", ranks == 1 ? "2" : "1"}, ranks);
    const std::vector<LevelCell> cells = sorted_cells(run);
    ASSERT_EQ(cells.size(), wanted.size()) << ranks;
    std::size_t different = 0;
    for (std::size_t n = 0; n < cells.size(); ++n)
      different += cells[n].value != wanted[n].value || cells[n].level != wanted[n].level ||
                   !(cells[n].cell == wanted[n].cell);
    EXPECT_EQ(different, 0u) << ranks;
  }
}

TEST(AmrCriteria, RegionsHoldTheirCellsFromTheStartToTheEnd) {
  const CaseRun run("amr_regions");
  EXPECT_EQ(regrids(run), 0);
  for (const char* when : {"first", "last"}) {
    int in_strip = 0, in_ball = 0, bare = 0;
    for (const LevelCell& c : level_cells(run, "rho_CC", 0, when)) {
      const bool strip = std::fabs(c.centre.x) < .75 && std::fabs(c.centre.y) < .1;
      const bool ball = std::hypot(c.centre.x - .5, c.centre.y - .5) < .25;
      bare += strip && c.level < 2 && !c.covered;
      bare += ball && c.level < 1 && !c.covered;
      in_strip += strip && c.level == 2;
      in_ball += ball && c.level == 1;
    }
    EXPECT_EQ(bare, 0);
    EXPECT_GT(in_strip, 0);
    EXPECT_GT(in_ball, 0);
  }
}

}  // namespace
}  // namespace sluice::verification
