// Which boxes share an array.
#include "framework/grid/box_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sluice::box_frames_test {
namespace {

using testing::ElementsAre;

// In a domain of 100 x 100 cells (x nz).
Level level_of(const std::vector<IndexBox>& boxes, int nz = 1) {
  Level level;
  level.domain = {{0, 0, 0}, {100, 100, nz}};
  level.active = {true, true, nz > 1};
  for (const IndexBox& b : boxes)
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  return level;
}

std::vector<std::vector<int>> members(const Level& level, int ghosts = 3) {
  std::vector<std::vector<int>> found;
  for (const BoxFrame& f : box_frames(level.boxes, level, ghosts)) found.push_back(f.boxes);
  return found;
}

TEST(BoxFrames, BoxesThatFollowEachOtherShareOne) {
  const Level level = level_of(
      {{{20, 10, 0}, {60, 18, 1}}, {{12, 18, 0}, {70, 26, 1}}, {{16, 26, 0}, {64, 40, 1}}});
  const std::vector<BoxFrame> frames = box_frames(level.boxes, level, 3);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_THAT(frames[0].boxes, ElementsAre(0, 1, 2));
  EXPECT_EQ(frames[0].hull, (IndexBox{{9, 7, 0}, {73, 43, 1}}));
  EXPECT_EQ(framed_cells(level, 0, 3), frames[0].hull.volume());
}

TEST(BoxFrames, EveryBoxLiesInOneAndFramesTakeNoMoreMemory) {
  std::vector<IndexBox> boxes;  // a ring
  for (int j = 0; j < 8; ++j) {
    const int reach = 8 * (j < 4 ? j + 1 : 8 - j);
    boxes.push_back({{50 - reach, 16 + 8 * j, 0}, {j == 3 ? 46 : 50, 24 + 8 * j, 1}});
    boxes.push_back({{j == 3 ? 54 : 50, 16 + 8 * j, 0}, {50 + reach, 24 + 8 * j, 1}});
  }
  const Level level = level_of(boxes);
  std::vector<int> times(boxes.size(), 0);
  std::int64_t apart = 0;
  for (const IndexBox& b : boxes) apart += b.grown({3, 3, 0}).volume();
  for (const BoxFrame& f : box_frames(level.boxes, level, 3))
    for (const int b : f.boxes) {
      ++times[b];
      EXPECT_TRUE(f.hull.contains(boxes[b].grown({3, 3, 0})));
    }
  EXPECT_THAT(times, testing::Each(1));
  EXPECT_LT(framed_cells(level, 0, 3), apart);
}

TEST(BoxFrames, WhatOthersOfAFrameProvide) {
  const Level level = level_of(
      {{{20, 10, 0}, {60, 18, 1}}, {{12, 18, 0}, {70, 26, 1}}, {{80, 10, 0}, {90, 26, 1}}});
  const auto held = held_by_frames(level, 3, Arrays::shared);
  EXPECT_THAT(held[0], ElementsAre(level.boxes[1].cells));
  EXPECT_THAT(held[1], ElementsAre(level.boxes[0].cells.grown({3, 3, 0})));
  EXPECT_THAT(held[2], ElementsAre());
  EXPECT_THAT(held_by_frames(level, 3, Arrays::own), testing::Each(ElementsAre()));
}

TEST(BoxFrames, BoxesAreAloneWhereGhostsMayDiffer) {
  // Beside a side across: its ghosts may depend on neighbours along the side.
  EXPECT_EQ(members(level_of({{{2, 10, 0}, {40, 18, 1}}, {{2, 18, 0}, {40, 26, 1}}})).size(), 2u);
  Level periodic = level_of({{{2, 10, 0}, {40, 18, 1}}, {{2, 18, 0}, {40, 26, 1}}});
  periodic.periodic[0] = true;
  EXPECT_EQ(members(periodic).size(), 1u);
  // At the low and the high end of the domain they share: ghosts beyond belong to one box alone.
  EXPECT_EQ(members(level_of({{{20, 0, 0}, {40, 50, 1}}, {{20, 50, 0}, {40, 100, 1}}})).size(), 1u);
  // Ghosts that reach beyond the next box.
  EXPECT_EQ(members(level_of({{{20, 10, 0}, {40, 12, 1}}, {{20, 12, 0}, {40, 20, 1}}})).size(), 2u);
}

TEST(BoxFrames, BoxesThatDoNotMeetOrWouldLeaveMuchEmptyAreAlone) {
  EXPECT_EQ(members(level_of({{{20, 10, 0}, {40, 18, 1}}, {{20, 20, 0}, {40, 28, 1}}})).size(), 2u);
  EXPECT_EQ(members(level_of({{{20, 10, 0}, {40, 18, 1}}, {{40, 18, 0}, {60, 26, 1}}})).size(), 2u);
  EXPECT_EQ(members(level_of({{{20, 10, 0}, {28, 60, 1}}, {{20, 60, 0}, {90, 68, 1}}})).size(), 2u);
}

TEST(BoxFrames, OfSeveralTheOneThatMeetsMostIsJoined) {
  const Level level = level_of(
      {{{20, 10, 0}, {30, 18, 1}}, {{30, 10, 0}, {60, 18, 1}}, {{20, 18, 0}, {60, 26, 1}}});
  EXPECT_THAT(members(level), ElementsAre(ElementsAre(0), ElementsAre(1, 2)));
}

TEST(BoxFrames, InThreeDimensionsTheyFollowAlongTheLast) {
  const Level level = level_of(
      {{{20, 20, 10}, {40, 40, 18}}, {{20, 20, 18}, {40, 40, 26}}, {{40, 20, 10}, {60, 40, 18}}},
      50);
  EXPECT_THAT(members(level), ElementsAre(ElementsAre(0, 1), ElementsAre(2)));
}

}  // namespace
}  // namespace sluice::box_frames_test
