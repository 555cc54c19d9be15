// Times of stages by name: in the order of the step, passes of one name together.
#include "framework/run/levels/stage_costs.hpp"

#include <gtest/gtest.h>

namespace sluice::stage_costs_test {
namespace {

TEST(StageCosts, StagesOfOneNameShareTheirTime) {
  StageCosts costs;
  const std::size_t solve = costs.place_of("solve"), move = costs.place_of("move");
  EXPECT_EQ(costs.place_of("solve"), solve);
  EXPECT_EQ(costs.measure(solve, [] { return 7; }), 7);
  EXPECT_EQ(costs.measure(move, [] { return 8; }), 8);
  ASSERT_EQ(costs.all().size(), 2u);
  EXPECT_EQ(costs.all()[0].name, "solve");
  EXPECT_GE(costs.all()[0].seconds, 0);
}

TEST(StageCosts, AreLinesOfATable) {
  RunReport report;
  EXPECT_EQ(stages_text(report), "");
  report.steps = 10;
  report.stepping_seconds = 2;
  report.stages = {{"solve", 1.5}, {"move", 0.5}};
  const std::string text = stages_text(report);
  EXPECT_NE(text.find("solve"), std::string::npos);
  EXPECT_NE(text.find("150 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("75.0 %"), std::string::npos) << text;
}

}  // namespace
}  // namespace sluice::stage_costs_test
