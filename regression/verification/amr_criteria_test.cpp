// What asks for finer levels: the estimated error against the uniform grid, regions of the deck,
// interfaces between materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "verification/amr_case.hpp"

namespace sluice::verification::amr_criteria_test {
namespace {

TEST(FullAmrCriteria, TheErrorCriterionIsAsGoodAsTheUniformFineGrid) {
  constexpr double allowed_loss = 1.05;   // density 1.033
  constexpr double allowed_share = 0.25;  // of cell updates, 0.22
  const CaseRun adaptive("amr_explosion_error");
  const CaseRun uniform("amr_explosion_error", {one_level(), resolution(512, 512)},
                        {"--threads", "2"});
  const double loss = adaptive.error("rho_CC").l1 / uniform.error("rho_CC").l1;
  record("rho_CC_by_uniform", loss);
  record("share_of_updates", share_of_uniform(adaptive));
  EXPECT_LE(loss, allowed_loss);
  EXPECT_LT(share_of_uniform(adaptive), allowed_share);
  EXPECT_GT(max_cells(adaptive).back(), 0);
}

void expect_a_wider_tolerance_to_cost_less(const std::vector<std::string>& changes) {
  const auto with = [&](const char* tolerance) {
    std::vector<std::string> overrides = changes;
    overrides.push_back("AMR/Regridder/max_levels=3");
    overrides.push_back("AMR/ErrorEstimate/@tolerance=" + std::string(tolerance));
    return CaseRun("amr_explosion_error", overrides);
  };
  const CaseRun strict = with("0.01"), loose = with("0.04");
  EXPECT_LT(share_of_uniform(loose), 0.8 * share_of_uniform(strict));
  EXPECT_GT(loose.error("rho_CC").l1, strict.error("rho_CC").l1);
}
TEST(AmrCriteria, AWiderToleranceCostsLessAndErrsMore) {
  expect_a_wider_tolerance_to_cost_less({"Time/maxTime=0.08", "DataArchiver/outputInterval=0.08"});
}
TEST(FullAmrCriteria, AWiderToleranceCostsLessAndErrsMore) {
  expect_a_wider_tolerance_to_cost_less({});
}

// Levels that start from the coarsest grid but one need their flags widened by less.
TEST(FullAmrCriteria, OneLevelOfRatioFourIsAsGoodForAFifthOfTheUpdates) {
  constexpr double allowed_loss = 1.05;   // density 1.023
  constexpr double allowed_share = 0.20;  // of cell updates, 0.186
  const CaseRun adaptive("amr_explosion_quarter");
  const CaseRun uniform("amr_explosion_quarter", {one_level(), resolution(256, 256)});
  const double loss = adaptive.error("rho_CC").l1 / uniform.error("rho_CC").l1;
  record("rho_CC_by_uniform", loss);
  record("share_of_updates", share_of_uniform(adaptive));
  EXPECT_LE(loss, allowed_loss);
  EXPECT_LT(share_of_uniform(adaptive), allowed_share);
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

// Runs on one and three ranks, one and two threads, hold the same cells.
void expect_one_result(const char* deck, const std::vector<std::string>& overrides) {
  const CaseRun one(deck, overrides);
  const std::vector<LevelCell> wanted = sorted_cells(one);
  EXPECT_GT(wanted.back().level, 1);
  for (const int ranks : {1, 3}) {
    const CaseRun run(deck, overrides, {"--threads", ranks == 1 ? "2" : "1"}, ranks);
    const std::vector<LevelCell> cells = sorted_cells(run);
    ASSERT_EQ(cells.size(), wanted.size()) << ranks;
    std::size_t different = 0;
    for (std::size_t n = 0; n < cells.size(); ++n)
      different += cells[n].value != wanted[n].value || cells[n].level != wanted[n].level ||
                   !(cells[n].cell == wanted[n].cell);
    EXPECT_EQ(different, 0u) << ranks;
  }
}

// Symmetric walls take the place of the other three quarters to the bit, tiles included.
TEST(AmrCriteria, AQuarterBetweenWallsIsThatOfTheWhole) {
  const CaseRun quarter("amr_explosion_quarter", {resolution(32, 32)});
  const CaseRun whole("amr_explosion_quarter",
                      {resolution(64, 64), "Grid/Level/Box/lower=[-1,-1,0]"});
  std::vector<LevelCell> cells = sorted_cells(whole);
  std::erase_if(cells, [](const LevelCell& c) { return c.centre.x < 0 || c.centre.y < 0; });
  const std::vector<LevelCell> wanted = sorted_cells(quarter);
  EXPECT_EQ(wanted.back().level, 1);
  ASSERT_EQ(cells.size(), wanted.size());
  std::size_t different = 0;
  for (std::size_t n = 0; n < cells.size(); ++n)
    different += cells[n].value != wanted[n].value || cells[n].level != wanted[n].level;
  EXPECT_EQ(different, 0u);
}

// The range of the variable is the same whoever holds the cells.
TEST(AmrCriteria, RanksAndThreadsDoNotShowInErrors) {
  expect_one_result("amr_explosion_error", {resolution(32, 32), "Time/maxTime=0.05"});
}

TEST(AmrCriteria, RanksAndThreadsDoNotShowAroundInterfaces) {
  expect_one_result("amr_followed_drop", {"Time/maxTime=0.0002"});
}

// A drop of radius 0.17 that moves by (1, -0.4) in a periodic square: its surface is where the
// exact solution has it, and so are the levels.
TEST(FullAmrCriteria, LevelsGoWithAnInterface) {
  constexpr double by_level[] = {0, 0.06, 0.02};  // distances of the deck
  const CaseRun run("amr_followed_drop");
  EXPECT_GT(regrids(run), 0);
  double area[2][3] = {};
  for (const bool last : {false, true}) {
    const double x = 0.4, y = last ? 0.2 : 0.6;
    const auto across = [](double d) { return d - std::round(d); };
    long bare = 0;
    for (const LevelCell& c : level_cells(run, "vol_frac_CC", 0, last ? "last" : "first")) {
      area[last][c.level] += c.volume / 0.04;
      if (c.covered) continue;
      const double r = std::hypot(across(c.centre.x - x), across(c.centre.y - y));
      for (int l = c.level + 1; l < 3; ++l) bare += std::fabs(r - 0.17) < by_level[l];
    }
    EXPECT_EQ(bare, 0) << last;
    // They are not simply everywhere. Widening, margins and tiles that have not gone yet are wide.
    EXPECT_LT(area[last][1], 0.6) << last;
    EXPECT_LT(area[last][2], 0.25) << last;
    EXPECT_GT(area[last][2], 2 * M_PI * 0.17 * 2 * by_level[2]) << last;
  }
  for (const int l : {1, 2}) record("area_" + std::to_string(l), area[1][l]);
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
}  // namespace sluice::verification::amr_criteria_test
