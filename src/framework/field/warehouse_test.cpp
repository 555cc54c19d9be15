// Storage of fields: layout, slots, alignment, swapping; labels as handles.
#include "framework/field/warehouse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace sluice::warehouse_test {
namespace {

Label label(int n) {
  return declare_label(
      {"test_warehouse_" + std::to_string(n), ValueType::real, Centring::cell, "1", "for tests"});
}

Level level_of(IntVec3 cells, IntVec3 pieces) {
  Level level;
  level.domain = {{0, 0, 0}, cells};
  for (int d = 0; d < 3; ++d) level.active[d] = cells[d] > 1;
  for (const IndexBox& b : split(level.domain, pieces))
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  return level;
}

TEST(Warehouse, HoldsInteriorAndGhostsZeroedAndAligned) {
  const Level level = level_of({8, 1, 6}, {2, 1, 1});
  Warehouse w(level, 0);
  const int slot = w.add({label(0), 0, 2, 3});
  ASSERT_EQ(w.local_boxes().size(), 2u);
  for (int b = 0; b < 2; ++b)
    for (int c = 0; c < 2; ++c) {
      const RealView v = w.view(slot, c, b);
      EXPECT_EQ(v.box, w.local_boxes()[b].cells.grown({3, 0, 3}));
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(v.data) % 64, 0u);
      for_each_cell(v.box, [&](IntVec3 cell) { EXPECT_EQ(v(cell), 0); });
    }
  EXPECT_EQ(w.bytes(), 2u * 2u * 10u * 12u * sizeof(double));
}

TEST(Warehouse, ComponentsOfABoxFollowEachOtherAtEqualDistances) {
  const Level level = level_of({600, 700, 1}, {1, 2, 1});
  Warehouse w(level, 0);
  const int slot = w.add({label(0), 0, 3, 2});
  for (int b = 0; b < 2; ++b) {
    const double* first = w.view(slot, 0, b).data;
    const auto distance = w.view(slot, 1, b).data - first;
    EXPECT_GE(distance, w.view(slot, 0, b).box.volume());
    EXPECT_EQ(w.view(slot, 2, b).data - first, 2 * distance);
  }
}

// What one box holds as ghosts are the other's cells.
TEST(Warehouse, BoxesThatFollowEachOtherMayShareArrays) {
  Level level = level_of({40, 40, 1}, {1, 1, 1});
  level.boxes = {{{{8, 8, 0}, {24, 16, 1}}, 0, 0}, {{{6, 16, 0}, {28, 30, 1}}, 0, 1}};
  Warehouse shared(level, 0, Arrays::shared), apart(level, 0);
  const int s = shared.add({label(0), 0, 2, 3}), a = apart.add({label(0), 0, 2, 3});
  for (int c = 0; c < 2; ++c) {
    EXPECT_EQ(shared.view(s, c, 0).box, apart.view(a, c, 0).box);
    EXPECT_EQ(&shared.view(s, c, 0)(8, 18, 0), &shared.view(s, c, 1)(8, 18, 0));
    EXPECT_NE(&apart.view(a, c, 0)(8, 18, 0), &apart.view(a, c, 1)(8, 18, 0));
  }
  EXPECT_EQ(shared.view(s, 1, 0).data - shared.view(s, 0, 0).data,
            shared.view(s, 1, 1).data - shared.view(s, 0, 1).data);
  EXPECT_EQ(shared.bytes(), 2u * 28u * 28u * sizeof(double));
  EXPECT_LT(shared.bytes(), apart.bytes());
}

TEST(Warehouse, RowsRunAlongTheFirstActiveDirectionAndInactiveOnesHaveNoStride) {
  const Level level = level_of({1, 5, 4}, {1, 1, 1});
  Warehouse w(level, 0);
  const RealView v = w.view(w.add({label(0), 0, 1, 2}), 0, 0);
  EXPECT_EQ(v.stride[0], 0);
  EXPECT_EQ(v.stride[1], 1);
  EXPECT_EQ(v.stride[2], 9);
  v(0, 3, 2) = 4;
  EXPECT_EQ(v(-5, 3, 2), 4);  // across an inactive direction there is only one layer
}

TEST(Warehouse, ASlotIsOneLabelOfOneMaterial) {
  const Level level = level_of({8, 1, 1}, {1, 1, 1});
  Warehouse w(level, 0);
  const int a = w.add({label(0), 0, 1, 2}), b = w.add({label(0), 1, 1, 2}),
            c = w.add({label(1), 0, 1, 2});
  EXPECT_EQ(w.slot_count(), 3);
  EXPECT_EQ(w.find(label(0), 0), a);
  EXPECT_EQ(w.find(label(0), 1), b);
  EXPECT_EQ(w.find(label(1), 0), c);
  EXPECT_EQ(w.find(label(1), 1), -1);
  EXPECT_EQ(w.add({label(0), 0, 1, 1}), a);  // narrower ghosts are there already
  EXPECT_THROW(w.add({label(0), 0, 1, 3}), std::logic_error);
  EXPECT_THROW(w.add({label(0), 0, 2, 2}), std::logic_error);
}

TEST(Warehouse, ViewsStayWhenSlotsAreAddedLater) {
  const Level level = level_of({8, 1, 1}, {1, 1, 1});
  Warehouse w(level, 0);
  const int slot = w.add({label(0), 0, 1, 2});
  double* const data = w.view(slot, 0, 0).data;
  for (int n = 1; n < 40; ++n) w.add({label(n), 0, 1, 2});
  EXPECT_EQ(w.view(slot, 0, 0).data, data);
}

TEST(Warehouse, ARankHoldsItsBoxesOnlyAndMayHoldNone) {
  Level level = level_of({8, 1, 1}, {4, 1, 1});
  level.boxes[1].owner = level.boxes[3].owner = 1;
  const Warehouse first(level, 0), second(level, 1);
  ASSERT_EQ(second.local_boxes().size(), 2u);
  EXPECT_EQ(second.local_boxes()[0].id, 1);
  EXPECT_EQ(second.local_boxes()[1].id, 3);
  EXPECT_EQ(first.local_boxes()[1].cells, level.boxes[2].cells);
  Warehouse none(level, 2);
  const int slot = none.add({label(0), 0, 1, 2});
  EXPECT_EQ(none.find(label(0), 0), slot);
  EXPECT_EQ(none.bytes(), 0u);
}

TEST(Warehouse, SwapExchangesOldAndNewWithoutCopying) {
  const Level level = level_of({8, 1, 1}, {1, 1, 1});
  Warehouse old(level, 0), now(level, 0);
  const int slot = old.add({label(0), 0, 1, 2});
  now.add({label(0), 0, 1, 2});
  now.view(slot, 0, 0)(3, 0, 0) = 5;
  double* const data = now.view(slot, 0, 0).data;
  old.swap(now);
  EXPECT_EQ(old.view(slot, 0, 0).data, data);
  EXPECT_EQ(old.view(slot, 0, 0)(3, 0, 0), 5);
  EXPECT_EQ(now.view(slot, 0, 0)(3, 0, 0), 0);
}

TEST(BlockLattice, FindsTheBlocksOfARegionNumberedAsTheyAreSplit) {
  const Level level = level_of({23, 10, 7}, {2, 1, 1});
  const BlockLattice lattice(level.boxes, {5, 4, 7});
  std::vector<IndexBox> blocks;
  for (const GridBox& b : level.boxes) {
    const IntVec3 n = b.cells.size();
    for (const IndexBox& piece : split(b.cells, {(n.x + 4) / 5, 3, 1})) blocks.push_back(piece);
  }
  ASSERT_EQ(lattice.size(), static_cast<int>(blocks.size()));
  const auto in_first = static_cast<int>(split(level.boxes[0].cells, {3, 3, 1}).size());
  for_each_cell({{-1, -1, 0}, {21, 9, 2}}, [&](IntVec3 low) {
    const IndexBox region{low, low + IntVec3{3, 2, 9}};
    for (int box = 0; box < 2; ++box) {
      std::vector<int> found, expected;
      lattice.any_block(box, region, [&](int n, const IndexBox& cells) {
        EXPECT_EQ(cells, blocks[n]);
        found.push_back(n);
        return false;
      });
      for (int n = box == 0 ? 0 : in_first; n < (box == 0 ? in_first : lattice.size()); ++n)
        if (!intersection(blocks[n], region).empty()) expected.push_back(n);
      ASSERT_EQ(found, expected);
    }
  });
  EXPECT_TRUE(lattice.any_block(0, level.domain, [](int n, const IndexBox&) { return n == 2; }));
  EXPECT_EQ(BlockLattice().extents(), IntVec3{});
}

// The only cell that is not zero is found from wherever it can be seen, however much is known.
TEST(Warehouse, FindsWhatIsNotZeroWhateverIsKnownOfBlocks) {
  const Level level = level_of({12, 9, 1}, {2, 1, 1});
  for (int known = 0; known < 3; ++known) {
    Warehouse w(level, 0);
    const int slot = w.add({label(0), 0, 1, 2});
    if (known > 0) w.cut({3, 4, 1});
    const RealView v = w.view(slot, 0, 1);
    for_each_cell(v.box, [&](IntVec3 cell) {
      v(cell) = 2;
      for (int block = 0; known == 2 && block < w.blocks().size(); ++block)
        w.set_uniform(slot, block, 0);
      if (known == 2)  // as whoever wrote the cell would say
        w.blocks().any_block(1, {cell, cell + IntVec3::all(1)}, [&](int block, const IndexBox&) {
          w.forget(slot, block);
          return false;
        });
      for_each_cell({{4, -2, 0}, {12, 9, 1}}, [&](IntVec3 low) {
        const IndexBox region = intersection({low, low + IntVec3{4, 3, 1}}, v.box);
        ASSERT_EQ(w.any_nonzero(slot, 0, 1, region), region.contains(cell));
      });
      v(cell) = 0;
    });
  }
}

// Cells, ghost cells, both components, whatever was known; what is known to be zero stays as it is.
TEST(Warehouse, ClearsWhatIsNotKnownToBeZero) {
  const Level level = level_of({12, 9, 1}, {2, 1, 1});
  for (const bool cut : {false, true}) {
    Warehouse w(level, 0);
    const int slot = w.add({label(0), 0, 2, 2});
    if (cut) w.cut({3, 4, 1});
    for (int c = 0; c < 2; ++c) fill(w.view(slot, c, 1), w.view(slot, c, 1).box, 7.0);
    w.clear(slot, 1);
    const IndexBox all = w.view(slot, 0, 1).box;
    for (int c = 0; c < 2; ++c) EXPECT_FALSE(any_other(w.view(slot, c, 1), all, 0.0));
    const IntVec3 first = w.local_boxes()[1].cells.lower, last = w.local_boxes()[1].cells.upper;
    const IntVec3 end = last - IntVec3{1, 1, 1};
    w.view(slot, 0, 1)(first) = w.view(slot, 0, 1)(end) = 5;
    w.forget(1, {first, first + IntVec3{1, 1, 1}});
    w.clear(slot, 1);
    EXPECT_EQ(w.view(slot, 0, 1)(first), 0);
    EXPECT_EQ(w.view(slot, 0, 1)(end), cut ? 5 : 0);  // nobody said that it was written
  }
}

// What lies outside of the parts that were filled is not looked at again.
TEST(Warehouse, ClearsThePartsThatTheLastCallNamed) {
  const Level level = level_of({12, 9, 1}, {2, 1, 1});
  Warehouse w(level, 0), other(level, 0);
  for (Warehouse* of : {&w, &other}) {
    of->add({label(0), 0, 1, 2});
    of->cut({3, 4, 1});
    fill(of->view(0, 0, 1), of->view(0, 0, 1).box, 7.0);
  }
  const IndexBox all = w.view(0, 0, 1).box, ghost{all.lower, all.lower + IntVec3{1, 1, 1}};
  w.clear_for(0, 1, {ghost});  // all of it, the first time
  EXPECT_FALSE(any_other(w.view(0, 0, 1), all, 0.0));
  w.view(0, 0, 1)(ghost.lower) = 3;
  w.view(0, 0, 1)(all.upper - IntVec3{1, 1, 1}) = 5;  // was not named
  w.swap(other);
  other.clear_for(0, 1, {});
  EXPECT_EQ(other.view(0, 0, 1)(ghost.lower), 0);
  EXPECT_EQ(other.view(0, 0, 1)(all.upper - IntVec3{1, 1, 1}), 5);
  w.clear_for(0, 1, {});
  EXPECT_FALSE(any_other(w.view(0, 0, 1), all, 0.0));
}

// Blocks are forgotten by their cells.
TEST(Warehouse, ForgetsTheBlocksThatMeet) {
  const Level level = level_of({12, 9, 1}, {1, 1, 1});
  Warehouse w(level, 0);
  w.add({label(0), 0, 1, 1});
  w.cut({3, 4, 1});
  for (int block = 0; block < w.blocks().size(); ++block) w.set_uniform(0, block, 2.0);
  int asked = 0;
  w.forget_where(0, [&](const IndexBox& cells) {
    ++asked;
    return cells.contains(IntVec3{4, 5, 0});
  });
  EXPECT_EQ(asked, w.blocks().size());
  int unknown = 0;
  for (int block = 0; block < w.blocks().size(); ++block)
    unknown += w.uniform(0, block) == 2.0 ? 0 : 1;
  EXPECT_EQ(unknown, 1);
}

TEST(Warehouse, WhatIsKnownGoesWithTheFieldsAndIsForgotten) {
  const Level level = level_of({12, 1, 1}, {1, 1, 1});
  Warehouse old(level, 0), now(level, 0);
  const int slot = old.add({label(0), 0, 1, 0});
  now.add({label(0), 0, 1, 0});
  for (Warehouse* w : {&old, &now}) w->cut({4, 1, 1});
  const int later = old.add({label(1), 0, 1, 0});
  EXPECT_TRUE(std::isnan(old.uniform(later, 2)));
  old.set_uniform(slot, 1, 1);
  EXPECT_TRUE(old.any_nonzero(slot, 0, 0, {{5, 0, 0}, {6, 1, 1}}));  // not read: it is known
  old.swap(now);
  EXPECT_EQ(now.uniform(slot, 1), 1);
  EXPECT_TRUE(std::isnan(old.uniform(slot, 1)));
  EXPECT_TRUE(std::isnan(now.uniform(slot, 0)));
  now.forget();
  EXPECT_TRUE(std::isnan(now.uniform(slot, 1)));
}

TEST(Label, IsOneHandleAName) {
  const Label a = label(0);
  EXPECT_EQ(declare_label(a.info()), a);
  EXPECT_EQ(find_label(a.name()), a);
  EXPECT_FALSE(find_label("no such label"));
  EXPECT_NE(a, label(1));
  EXPECT_FALSE(Label().valid());
  EXPECT_THROW(Label().info(), std::logic_error);
}

TEST(Label, RefusesASecondMeaning) {
  LabelInfo other = label(0).info();
  other.centring = Centring::x_face;
  try {
    declare_label(other);
    FAIL() << "accepted";
  } catch (const std::logic_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("test_warehouse_0"));
  }
}

TEST(Label, ANameMeansTheOneClaimedLast) {
  const LabelInfo in_cells{"test_claimed", ValueType::real, Centring::cell, "1", "of cells"};
  LabelInfo on_nodes = in_cells;
  on_nodes.centring = Centring::node;
  const Label cells = claim_label(in_cells), nodes = claim_label(on_nodes);
  EXPECT_NE(cells, nodes);
  EXPECT_EQ(find_label("test_claimed"), nodes);
  EXPECT_EQ(claim_label(in_cells), cells);
  EXPECT_EQ(find_label("test_claimed"), cells);
  EXPECT_EQ(nodes.info().centring, Centring::node);
}

TEST(Label, ValuesThatCloseABox) {
  EXPECT_EQ(closing_layers(Centring::cell), (IntVec3{0, 0, 0}));
  EXPECT_EQ(closing_layers(Centring::node), (IntVec3{1, 1, 1}));
  EXPECT_EQ(closing_layers(Centring::y_face), (IntVec3{0, 1, 0}));
}

TEST(Label, AllLabelsAreSortedByName) {
  label(2);
  const std::vector<Label> all = all_labels();
  EXPECT_GE(all.size(), 3U);
  for (std::size_t n = 1; n < all.size(); ++n) EXPECT_LE(all[n - 1].name(), all[n].name());
}

}  // namespace
}  // namespace sluice::warehouse_test
