// Marks of parts of rows, against what was said of each cell last.
#include "framework/field/row_marks.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace sluice::row_marks_test {
namespace {

Level level_of(const IndexBox& domain) {
  Level level;
  level.domain = domain;
  for (int d = 0; d < 3; ++d) level.active[d] = domain.size()[d] > 1;
  return level;
}

// The cells that `row` covers, in the order of for_each, with their marks.
std::vector<int> marks_of(const RowMarks& marks, IntVec3 cell, int n) {
  std::vector<int> found;
  marks.for_each(cell, n, [&](int first, int count, int mark) {
    EXPECT_EQ(first, static_cast<int>(found.size()));
    EXPECT_GT(count, 0);
    found.insert(found.end(), count, mark);
  });
  EXPECT_EQ(static_cast<int>(found.size()), n);
  return found;
}

TEST(RowMarks, SayOfNoCellWhatIsNotSo) {
  constexpr int part = RowMarks::cells;
  for (const IndexBox& box :
       {IndexBox{{-3, 4, 0}, {2 * part + 5, 7, 2}}, IndexBox{{0, 7, 2}, {1, 7 + 3 * part, 4}},
        IndexBox{{5, 0, 0}, {9, 1, 1}}}) {
    const Level level = level_of(box);
    const int along = level.active[0] ? 0 : 1, size = box.size()[along];
    RowMarks marks(box, level);
    std::map<std::tuple<int, int, int>, int> said;
    std::mt19937 random(1);
    const auto any = [&](int below) {
      return static_cast<int>(random() % static_cast<unsigned>(below));
    };
    int known = 0;
    for (int time = 0; time < 400; ++time) {
      IntVec3 cell;
      for (int d = 0; d < 3; ++d) cell[d] = box.lower[d] + any(box.size()[d]);
      if (any(2) == 0) cell[along] = box.lower[along];
      const int room = box.upper[along] - cell[along], n = any(2) == 0 ? room : 1 + any(room);
      const int mark = any(3);
      marks.set(cell, n, mark);
      for (int i = 0; i < n; ++i) {
        IntVec3 c = cell;
        c[along] += i;
        said[{c.x, c.y, c.z}] = mark;
      }
      cell[along] = box.lower[along] - 2;
      const std::vector<int> found = marks_of(marks, cell, size + 4);
      for (int i = 0; i < size + 4; ++i) {
        const int here = found[i];
        IntVec3 c = cell;
        c[along] += i;
        if (here != 0) {
          ASSERT_EQ(here, (said[{c.x, c.y, c.z}]));
          ++known;
        }
      }
    }
    EXPECT_GT(known, 400);
  }
}

TEST(RowMarks, KnowWholePartsAndForget) {
  constexpr int part = RowMarks::cells;
  const IndexBox box{{0, 0, 0}, {2 * part + 3, 4, 1}};
  RowMarks marks(box, level_of(box));
  const IntVec3 row{0, 2, 0};
  marks.set(row, box.upper.x, 7);
  EXPECT_EQ(marks_of(marks, row, box.upper.x), std::vector<int>(2 * part + 3, 7));
  // One cell that is no longer so takes its part along; one that still is does not.
  marks.set({part, 2, 0}, 1, 7);
  EXPECT_EQ(marks_of(marks, {part, 2, 0}, 1), std::vector<int>{7});
  marks.set({part, 2, 0}, 1, 8);
  EXPECT_EQ(marks_of(marks, {part, 2, 0}, part), std::vector<int>(part, 0));
  EXPECT_EQ(marks_of(marks, {2 * part, 2, 0}, 3), std::vector<int>(3, 7));
  // Rows beside the box, and other rows of it.
  EXPECT_EQ(marks_of(marks, {0, 4, 0}, 5), std::vector<int>(5, 0));
  EXPECT_EQ(marks_of(marks, {0, 1, 0}, 5), std::vector<int>(5, 0));
  marks.clear({{0, 2, 0}, {part, 3, 1}});
  EXPECT_EQ(marks_of(marks, row, 1), std::vector<int>{0});
  EXPECT_EQ(marks_of(marks, {2 * part, 2, 0}, 3), std::vector<int>(3, 7));
  marks.clear();
  EXPECT_EQ(marks_of(marks, row, box.upper.x), std::vector<int>(2 * part + 3, 0));
}

}  // namespace
}  // namespace sluice::row_marks_test
