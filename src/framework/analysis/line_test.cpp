// Cells along lines: parallel to an axis, slanted, stepped, clipped, on faces between cells.
#include "framework/analysis/line.hpp"

#include <gtest/gtest.h>

namespace sluice::line_test {
namespace {

// 10 x 4 x 1 cells over [0, 1] x [-0.2, 0.2] x [0, 0.1].
Level ten_by_four() {
  Level level;
  level.anchor = {0, -0.2, 0};
  level.spacing = {0.1, 0.1, 0.1};
  level.domain = {{0, 0, 0}, {10, 4, 1}};
  level.boxes = {{level.domain, 0, 0}};
  return level;
}

AnalysedLine line(Vec3 start, Vec3 end, double step = 0) {
  AnalysedLine l;
  l.start = start;
  l.end = end;
  l.step = step;
  return l;
}

TEST(AnalysisLine, WithoutAStepEveryCellComesOnceInOrder) {
  const LineCells found = cells_on_line(line({1, 0.15, 0.05}, {0, 0.15, 0.05}), ten_by_four());
  ASSERT_EQ(found.cells.size(), 10u);
  for (int n = 0; n < 10; ++n) EXPECT_EQ(found.cells[n], (IntVec3{9 - n, 3, 0}));
  EXPECT_FALSE(found.clipped);
}

TEST(AnalysisLine, AStepOfOneCellFindsEveryCellDespiteRounding) {
  const LineCells found = cells_on_line(line({0, 0.05, 0}, {1, 0.05, 0}, 0.1), ten_by_four());
  ASSERT_EQ(found.cells.size(), 10u);  // the eleventh point is on the high end: the last cell again
  EXPECT_EQ(found.cells.front(), (IntVec3{0, 2, 0}));
  EXPECT_EQ(found.cells.back(), (IntVec3{9, 2, 0}));
  EXPECT_FALSE(found.clipped);
}

TEST(AnalysisLine, ALargerStepLeavesCellsOut) {
  const LineCells found =
      cells_on_line(line({0.05, 0.05, 0.05}, {0.95, 0.05, 0.05}, 0.4), ten_by_four());
  EXPECT_EQ(found.cells, (std::vector<IntVec3>{{0, 2, 0}, {4, 2, 0}, {8, 2, 0}}));
}

TEST(AnalysisLine, ASlantedLineCrossesEveryCellOnItsWay) {
  const LineCells found =
      cells_on_line(line({0.01, -0.19, 0.05}, {0.21, 0.01, 0.05}), ten_by_four());
  EXPECT_EQ(found.cells, (std::vector<IntVec3>{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}));
  const LineCells steep =
      cells_on_line(line({0.05, -0.19, 0.05}, {0.15, 0.19, 0.05}), ten_by_four());
  EXPECT_EQ(steep.cells, (std::vector<IntVec3>{{0, 0, 0}, {0, 1, 0}, {1, 2, 0}, {1, 3, 0}}));
}

TEST(AnalysisLine, OnAFaceTheUpperCellIsMeant) {
  const LineCells found = cells_on_line(line({0.3, 0, 0.05}, {0.5, 0, 0.05}), ten_by_four());
  EXPECT_EQ(found.cells, (std::vector<IntVec3>{{3, 2, 0}, {4, 2, 0}}));
  const LineCells point = cells_on_line(line({0.3, 0, 0.05}, {0.3, 0, 0.05}), ten_by_four());
  EXPECT_EQ(point.cells, (std::vector<IntVec3>{{3, 2, 0}}));
}

TEST(AnalysisLine, WhatLiesOutsideTheDomainIsLeftOutAndSaidSo) {
  const LineCells found =
      cells_on_line(line({-0.55, 0.05, 0.05}, {0.25, 0.05, 0.05}, 0.1), ten_by_four());
  EXPECT_TRUE(found.clipped);  // the points stay at start + n step
  EXPECT_EQ(found.cells, (std::vector<IntVec3>{{0, 2, 0}, {1, 2, 0}, {2, 2, 0}}));
  const LineCells away = cells_on_line(line({0, 5, 0}, {1, 5, 0}), ten_by_four());
  EXPECT_TRUE(away.clipped);
  EXPECT_TRUE(away.cells.empty());
  const LineCells far = cells_on_line(line({-1e300, 0.05, 0.05}, {1, 0.05, 0.05}), ten_by_four());
  EXPECT_TRUE(far.clipped);
}

TEST(AnalysisLine, AMinuteStepIsNoEndlessLoop) {
  const LineCells found =
      cells_on_line(line({0, 0.05, 0.05}, {1, 0.05, 0.05}, 1e-300), ten_by_four());
  EXPECT_EQ(found.cells.size(), 10u);
}

}  // namespace
}  // namespace sluice::line_test
