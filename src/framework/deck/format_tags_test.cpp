// The table of what the format knows.
#include "framework/deck/format_tags.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sluice::format_tags_test {
namespace {

TEST(FormatTags, KnowTheirParents) {
  EXPECT_TRUE(known_to_format("", "MPM"));
  EXPECT_TRUE(known_to_format("CFD/ICE", "turbulence"));
  EXPECT_TRUE(known_to_format("CFD/ICE/turbulence", "model_constant"));
  EXPECT_FALSE(known_to_format("CFD", "turbulence"));
  EXPECT_FALSE(known_to_format("", "Modles"));
  EXPECT_FALSE(known_to_format("no/such/path", "cfl"));
}

TEST(FormatTags, HoldForPiecesWhereverTheyStand) {
  EXPECT_TRUE(known_to_format("MaterialProperties/ICE/material/geom_object", "volumeFraction"));
  EXPECT_TRUE(known_to_format("anywhere/union", "box"));
  EXPECT_FALSE(known_to_format("anywhere/union", "cube"));
}

TEST(FormatTags, TellWhereANameBelongs) {
  const auto parents = parents_in_format("cfl");
  EXPECT_NE(std::find(parents.begin(), parents.end(), "CFD"), parents.end());
  EXPECT_TRUE(parents_in_format("nonsense").empty());
}

}  // namespace
}  // namespace sluice::format_tags_test
