// What a deck saves against what its run computes.
#include "framework/run/simulation/run_labels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/run/test_support/mock_component.hpp"

namespace sluice::run_labels_test {
namespace {

using run_test::MockComponent;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Settled {
  std::vector<std::string> labels;
  std::string told;
  bool refused = false;
};

Settled settle(const std::vector<std::string>& labels) {
  OutputSettings output;
  for (const std::string& label : labels) {
    SaveRequest request;
    request.label = label;
    output.saves.push_back(request);
  }
  const Level level;
  const MockComponent component(level);
  std::vector<Fault> faults;
  settle_saves(output, component, RunLabels(component, {"MockTotal"}), faults);
  Settled settled;
  for (const SaveRequest& save : output.saves) settled.labels.push_back(save.label);
  for (const Fault& fault : faults) {
    settled.told += to_string(fault) + '\n';
    settled.refused = settled.refused || fault.severity == Severity::error;
  }
  return settled;
}

TEST(RunLabels, KnownOnesThatTheRunLacksAreTakenOutWithAWarning) {
  const Settled s = settle({"mock_flux", "p.stress", "MockTotal", "mock_square"});
  EXPECT_THAT(s.labels, ElementsAre("mock_flux", "MockTotal", "mock_square"));
  EXPECT_FALSE(s.refused) << s.told;
  EXPECT_THAT(s.told, HasSubstr("variable 'p.stress' is not computed by this run"));
  EXPECT_EQ(settle({"mock_flux", "MockTotal"}).told, "");
}

TEST(RunLabels, TheNearestThatThereIsIsNamed) {
  EXPECT_THAT(settle({"mock_flux", "pi", "mock_squar"}).told,
              HasSubstr("there is no variable 'mock_squar' (did you mean 'mock_square'?)"));
}

TEST(RunLabels, OtherSpellingsAreReadAsTheirs) {
  const Settled s = settle({"Mock_Flux"});
  EXPECT_THAT(s.labels, ElementsAre("mock_flux"));
  EXPECT_FALSE(s.refused) << s.told;
}

TEST(RunLabels, AllThatNobodyKnowsAreToldInOnePass) {
  const Settled s = settle({"one_thing", "mock_flux", "another_thing"});
  EXPECT_TRUE(s.refused);
  EXPECT_THAT(s.told, HasSubstr("there is no variable 'one_thing'"));
  EXPECT_THAT(s.told, HasSubstr("there is no variable 'another_thing'"));
}

TEST(RunLabels, NothingLeftToSaveIsAnError) {
  const Settled s = settle({"p.stress", "max_RHS"});
  EXPECT_TRUE(s.labels.empty());
  EXPECT_TRUE(s.refused);
  EXPECT_THAT(s.told, HasSubstr("no variable that this deck saves is computed by its run"));
  EXPECT_FALSE(settle({}).refused);
}

}  // namespace
}  // namespace sluice::run_labels_test
