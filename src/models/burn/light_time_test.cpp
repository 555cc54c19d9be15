// A prescribed front: distances from points and planes, and the share that it has burned.
#include "models/burn/light_time.hpp"

#include <gtest/gtest.h>

namespace sluice::models::light_time_test {
namespace {

TEST(LightTime, RunsFromAPointOrAPlane) {
  LightTime law;
  law.front = detonation_front({1, 0, 0}, {});
  EXPECT_DOUBLE_EQ(law.front.distance({1, 3, 4}), 5);
  law.front = detonation_front({1, 0, 0}, {0, 2, 0});
  EXPECT_DOUBLE_EQ(law.front.distance({1, 3, 4}), 3);
  EXPECT_DOUBLE_EQ(law.front.distance({7, -3, 4}), 3);
}

TEST(LightTime, BurnsOverItsWidth) {
  LightTime law;
  law.D = 10;
  EXPECT_EQ(law.share({5, 0, 0}, 0.5, 1), 0);  // it arrives
  EXPECT_DOUBLE_EQ(law.share({5, 0, 0}, 0.575, 1), 0.5);
  EXPECT_EQ(law.share({5, 0, 0}, 0.645, 1), 1);  // 0.967
  EXPECT_EQ(law.share({50, 0, 0}, 0.6, 1), 0);
}

}  // namespace
}  // namespace sluice::models::light_time_test
