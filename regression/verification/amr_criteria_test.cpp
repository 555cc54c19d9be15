// What asks for finer levels: the estimated error against the uniform grid, regions of the deck.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/amr_case.hpp"

namespace sluice::verification {
namespace {

TEST(AmrCriteria, TheErrorCriterionIsAsGoodAsTheUniformFineGrid) {
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
