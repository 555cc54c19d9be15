// Every recorded face is found from its row, and by the block of its cell.
#include "framework/refine/face_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace sluice::face_table_test {
namespace {

struct Region {
  int box, axis;
  bool high;
  IndexBox cells;
};

// The slots that a walk over all rows of the boxes finds, each at its cell.
void expect_found(const std::vector<GridBox>& boxes, const Axes& axes,
                  const std::vector<Region>& regions) {
  FaceTable table(boxes, axes, 3);
  std::vector<std::ptrdiff_t> first;
  for (const Region& r : regions) first.push_back(table.add(r.box, r.axis, r.high, r.cells));
  table.seal();
  std::set<std::ptrdiff_t> seen;
  const int along = axes.direction[0];
  for (std::size_t n = 0; n < regions.size(); ++n) {
    const Region& r = regions[n];
    std::ptrdiff_t slot = first[n];
    for_each_cell(r.cells, [&](IntVec3 c) {  // x fastest
      int found = 0;
      for (const FaceTable::Segment& s : table.segments(r.box, r.axis, c)) {
        if (r.axis == 0) {
          EXPECT_EQ(s.count, 1);
        }
        if (s.high == r.high && s.first <= c[along] && c[along] < s.first + s.count) {
          EXPECT_EQ(s.slot + c[along] - s.first, slot);
          ++found;
        }
      }
      EXPECT_EQ(found, 1);
      EXPECT_TRUE(table.touches(r.box, {c, c + IntVec3::all(1)}));
      EXPECT_TRUE(seen.insert(slot++).second);
    });
  }
  EXPECT_EQ(static_cast<std::ptrdiff_t>(seen.size()), table.faces());
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for_each_cell(boxes[b].cells, [&](IntVec3 c) {
      bool any = false;
      for (const Region& r : regions)
        any = any || (r.box == static_cast<int>(b) && r.cells.contains(c));
      EXPECT_EQ(table.touches(static_cast<int>(b), {c, c + IntVec3::all(1)}), any);
    });
}

TEST(FaceTable, FindsFacesOfLinesPlanesAndSpace) {
  const Axes x{1, {0, 1, 2}}, y{1, {1, 0, 2}}, yz{2, {1, 2, 0}}, xyz{3, {0, 1, 2}};
  expect_found({{{{2, 0, 0}, {9, 1, 1}}, 0, 0}}, x,
               {{0, 0, true, {{4, 0, 0}, {5, 1, 1}}}, {0, 0, false, {{4, 0, 0}, {5, 1, 1}}}});
  expect_found({{{{0, -3, 0}, {1, 4, 1}}, 0, 0}}, y, {{0, 0, true, {{0, -1, 0}, {1, 0, 1}}}});
  expect_found({{{{0, 0, 0}, {1, 6, 4}}, 0, 0}, {{{0, 6, 0}, {1, 9, 4}}, 0, 1}}, yz,
               {{1, 0, false, {{0, 6, 1}, {1, 7, 3}}},
                {0, 1, true, {{0, 1, 3}, {1, 5, 4}}},
                {0, 1, false, {{0, 2, 3}, {1, 3, 4}}}});
  expect_found({{{{4, 4, 4}, {9, 9, 9}}, 0, 0}}, xyz,
               {{0, 2, true, {{5, 4, 8}, {8, 9, 9}}},
                {0, 1, true, {{4, 8, 4}, {9, 9, 6}}},
                {0, 0, false, {{4, 5, 5}, {5, 7, 9}}},
                {0, 0, true, {{8, 5, 5}, {9, 7, 9}}}});
}

TEST(FaceTable, TouchesABlockWhereAnyOfItsFacesLie) {
  FaceTable table({{{{0, 0, 0}, {32, 16, 1}}, 0, 0}}, Axes{2, {0, 1, 2}}, 1);
  table.add(0, 1, false, {{10, 5, 0}, {20, 6, 1}});
  table.seal();
  EXPECT_TRUE(table.touches(0, {{0, 0, 0}, {11, 16, 1}}));
  EXPECT_TRUE(table.touches(0, {{19, 5, 0}, {32, 6, 1}}));
  EXPECT_FALSE(table.touches(0, {{20, 0, 0}, {32, 16, 1}}));
  EXPECT_FALSE(table.touches(0, {{0, 6, 0}, {32, 16, 1}}));
  EXPECT_FALSE(table.touches(0, {{0, 0, 0}, {32, 5, 1}}));
  EXPECT_FALSE(table.touches(0, {{0, 0, 0}, {10, 16, 1}}));
}

TEST(FaceTable, TellsWhichCellsOfABlockHaveFaces) {
  FaceTable table({{{{0, 0, 0}, {32, 16, 1}}, 0, 0}}, Axes{2, {0, 1, 2}}, 1);
  table.add(0, 1, false, {{10, 5, 0}, {20, 6, 1}});
  table.add(0, 1, true, {{4, 9, 0}, {12, 10, 1}});
  table.add(0, 0, true, {{31, 2, 0}, {32, 8, 1}});
  table.seal();
  const IndexBox whole{{0, 0, 0}, {32, 16, 1}};
  EXPECT_EQ(table.cells_with_faces(0, 1, whole), (IndexBox{{4, 5, 0}, {20, 10, 1}}));
  EXPECT_EQ(table.cells_with_faces(0, 0, whole), (IndexBox{{31, 2, 0}, {32, 8, 1}}));
  EXPECT_EQ(table.cells_with_faces(0, 1, {{0, 0, 0}, {16, 8, 1}}),
            (IndexBox{{10, 5, 0}, {16, 6, 1}}));
  EXPECT_TRUE(table.cells_with_faces(0, 1, {{0, 6, 0}, {32, 9, 1}}).empty());  // between the two
  EXPECT_TRUE(table.cells_with_faces(0, 0, {{0, 0, 0}, {31, 16, 1}}).empty());
}

TEST(FaceTable, KeepsEachQuantityInOnePiece) {
  FaceTable table({{{{0, 0, 0}, {8, 8, 1}}, 0, 0}}, Axes{2, {0, 1, 2}}, 2);
  table.add(0, 0, true, {{7, 0, 0}, {8, 8, 1}});
  table.seal();
  table.values(0)[7] = 1;
  table.values(1)[0] = 2;
  table.clear();
  EXPECT_EQ(table.values(0)[7], 0);
  EXPECT_EQ(table.values(1)[0], 0);
  EXPECT_GE(table.bytes(), 16 * sizeof(double));
}

TEST(FaceTable, HasNoRowsOutsideItsBoxes) {
  FaceTable table({{{{0, 0, 0}, {8, 8, 1}}, 0, 0}}, Axes{2, {0, 1, 2}}, 1);
  table.add(0, 0, true, {{7, 0, 0}, {8, 8, 1}});
  table.seal();
  EXPECT_TRUE(table.segments(0, 0, {0, -1, 0}).empty());
  EXPECT_TRUE(table.segments(0, 0, {0, 8, 0}).empty());
  EXPECT_EQ(table.segments(0, 0, {3, 7, 0}).size(), 1u);
  EXPECT_TRUE(table.segments(0, 1, {3, 7, 0}).empty());
}

TEST(FaceTable, TakesOnlyLayersOfItsBoxes) {
  FaceTable table({{{{0, 0, 0}, {8, 8, 1}}, 0, 0}}, Axes{2, {0, 1, 2}}, 1);
  EXPECT_THROW(table.add(0, 0, true, {{6, 0, 0}, {8, 8, 1}}), std::logic_error);
  EXPECT_THROW(table.add(0, 1, true, {{0, 8, 0}, {8, 9, 1}}), std::logic_error);
}

}  // namespace
}  // namespace sluice::face_table_test
