// Edit distance and the nearest valid name.
#include "framework/deck/nearest_name.hpp"

#include <gtest/gtest.h>

namespace sluice::nearest_name_test {
namespace {

TEST(EditDistance, CountsEditsAndSwapsButNotCase) {
  EXPECT_EQ(edit_distance("cfl", "cfl"), 0u);
  EXPECT_EQ(edit_distance("clf", "cfl"), 1u);
  EXPECT_EQ(edit_distance("CFL", "cfl"), 0u);
  EXPECT_EQ(edit_distance("Velocty", "Velocity"), 1u);
  EXPECT_EQ(edit_distance("idael_gas", "ideal_gas"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
}

TEST(NearestName, FindsTheLikelyOne) {
  const std::vector<std::string> names = {"gamma", "density", "pressure"};
  EXPECT_EQ(nearest_name("gama", names), "gamma");
  EXPECT_EQ(nearest_name("presure", names), "pressure");
}

TEST(NearestName, GivesNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("helicity", {"gamma", "density"}), std::nullopt);
  EXPECT_EQ(nearest_name("x", {"density"}), std::nullopt);
  EXPECT_EQ(nearest_name("gamma", {}), std::nullopt);
}

TEST(SuggestName, ListsAFewNamesWhenNoneIsNear) {
  EXPECT_EQ(suggest_name("helicity", {"gamma", "density"}), "valid: gamma, density");
  EXPECT_EQ(suggest_name("gama", {"gamma", "density"}), "did you mean 'gamma'?");
}

}  // namespace
}  // namespace sluice::nearest_name_test
