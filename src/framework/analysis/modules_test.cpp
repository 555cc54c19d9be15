// When samples are taken.
#include "framework/analysis/modules.hpp"

#include <gtest/gtest.h>

namespace sluice::modules_test {
namespace {

TEST(SampleIsDue, FromTimeStartToTimeStopNoMoreOftenThanAsked) {
  AnalysisModule m;
  m.sampling_frequency = 4;
  m.time_start = 1;
  m.time_stop = 2;
  EXPECT_FALSE(sample_is_due(m, {}, 0.999));
  EXPECT_TRUE(sample_is_due(m, {}, 1.0));
  EXPECT_TRUE(sample_is_due(m, {}, 2.0));
  EXPECT_FALSE(sample_is_due(m, {}, 2.001));
  EXPECT_FALSE(sample_is_due(m, 1.0, 1.249));
  EXPECT_TRUE(sample_is_due(m, 1.0, 1.25));
  m.sampling_frequency = 0;  // every step
  EXPECT_TRUE(sample_is_due(m, 1.0, 1.0001));
}

}  // namespace
}  // namespace sluice::modules_test
