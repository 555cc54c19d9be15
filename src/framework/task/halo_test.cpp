// Ghost cells are copies of the cells they stand for: every box, edge and corner, every rank.
//
// Registered once more on three ranks (CMakeLists.txt).
#include "framework/task/halo.hpp"

#include <gtest/gtest.h>

#include "framework/base/close_ranks_test_support.hpp"
#include "framework/task/sweep_test_support.hpp"

namespace sluice::halo_test {
namespace {

using namespace sweep_test;

constexpr double untouched = -7;

double value_of(int slot, int component, IntVec3 c) {
  return slot * 1e7 + component * 1e6 + c.x + 100.0 * c.y + 10000.0 * c.z;
}

// The cell that a ghost stands for, or nothing where it lies outside a domain that ends.
bool wrapped(const Level& level, IntVec3& c) {
  for (int d = 0; d < 3; ++d) {
    const int size = level.domain.size()[d], low = level.domain.lower[d];
    if (c[d] >= low && c[d] < low + size) continue;
    if (!level.periodic[d]) return false;
    c[d] = low + ((c[d] - low) % size + size) % size;
  }
  return true;
}

void expect_filled(Level level, int width, const ThreadTeam* team, Arrays arrays) {
  Communicator& ranks = world();
  assign_owners(level.boxes, ranks.size());
  Warehouse state(level, ranks.rank(), arrays);
  const std::vector<int> slots = {state.add({test_label(0), 0, 2, width}),
                                  state.add({test_label(1), 0, 1, width})};
  const auto each = [&](auto&& f) {
    for (int s : slots)
      for (int c = 0; c < state.info(s).components; ++c)
        for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
          f(s, c, state.view(s, c, b), state.local_boxes()[b].cells);
  };
  each([](int, int, const RealView& v, const IndexBox&) { fill(v, v.box, untouched); });
  each([](int s, int c, const RealView& v, const IndexBox& cells) {
    for_each_cell(cells, [&](IntVec3 cell) { v(cell) = value_of(s, c, cell); });
  });
  HaloExchange halo(level, width, ranks.rank(), arrays);
  for (int again = 0; again < 2; ++again) halo.run(state, slots, team);
  each([&](int s, int c, const RealView& v, const IndexBox&) {
    for_each_cell(v.box, [&](IntVec3 cell) {
      IntVec3 source = cell;
      const double wanted = wrapped(level, source) ? value_of(s, c, source) : untouched;
      ASSERT_EQ(v(cell), wanted) << "slot " << s << " at " << cell.x << ' ' << cell.y << ' '
                                 << cell.z;
    });
  });
}

void expect_filled(const Level& level, int width, const ThreadTeam* team = nullptr) {
  for (const Arrays arrays : {Arrays::own, Arrays::shared}) {
    SCOPED_TRACE(arrays == Arrays::own ? "own arrays" : "shared arrays");
    expect_filled(level, width, team, arrays);
  }
}

struct Case {
  IntVec3 cells, pieces;
  std::array<bool, 3> periodic;
  int width;
};

class HaloOnShapes : public testing::TestWithParam<Case> {};

TEST_P(HaloOnShapes, FillsFacesEdgesAndCorners) {
  const Case& c = GetParam();
  Level level = level_of(c.cells, c.pieces, {-4, 3, 1});
  level.periodic = c.periodic;
  expect_filled(level, c.width);
}

INSTANTIATE_TEST_SUITE_P(
    Halo, HaloOnShapes,
    testing::Values(Case{{20, 1, 1}, {1, 1, 1}, {true, false, false}, 3},
                    Case{{20, 1, 1}, {5, 1, 1}, {false, false, false}, 3},
                    Case{{20, 1, 1}, {5, 1, 1}, {true, true, true}, 3},
                    Case{{9, 12, 1}, {2, 3, 1}, {true, true, false}, 3},
                    Case{{9, 12, 1}, {2, 3, 1}, {false, true, false}, 2},
                    Case{{1, 12, 9}, {1, 4, 2}, {false, true, true}, 3},
                    Case{{8, 7, 9}, {2, 2, 3}, {true, true, true}, 3},
                    Case{{8, 7, 9}, {2, 2, 3}, {false, false, false}, 1},
                    // boxes narrower than the halo: a ghost comes from the box beyond the next
                    Case{{12, 4, 1}, {12, 1, 1}, {true, false, false}, 3},
                    Case{{6, 6, 6}, {3, 3, 3}, {true, false, true}, 3},
                    // the domain is narrower than the halo: a ghost is the image of an image
                    Case{{2, 8, 1}, {1, 2, 1}, {true, true, false}, 3},
                    Case{{2, 2, 2}, {2, 1, 1}, {true, true, true}, 3},
                    // the whole domain is as wide as the halo
                    Case{{3, 8, 1}, {1, 2, 1}, {true, true, false}, 3},
                    // the halo is wider than the domain, which goes round more than once
                    Case{{2, 3, 4}, {1, 1, 2}, {true, true, true}, 3},
                    Case{{2, 6, 1}, {2, 3, 1}, {true, true, false}, 4}));

TEST(Halo, ManyCopiesAreSharedAmongThreads) {
  Level level = level_of({256, 192, 1}, {16, 12, 1}, {-4, 3, 1});
  level.periodic = {true, false, false};
  const ThreadTeam team(3);
  expect_filled(level, 3, &team);
}

// Boxes of unequal width that follow each other, beside a tall one: what lies in one frame is not
// copied, and what lies beyond is, once.
TEST(Halo, BoxesOfAFrameNeedNoCopiesOfEachOther) {
  Level level = level_of({64, 40, 1});
  level.boxes.clear();
  for (const IndexBox& cells :
       {IndexBox{{16, 8, 0}, {30, 14, 1}}, IndexBox{{12, 14, 0}, {30, 18, 1}},
        IndexBox{{8, 18, 0}, {30, 30, 1}}, IndexBox{{30, 10, 0}, {40, 28, 1}}})
    level.boxes.push_back({cells, 0, static_cast<int>(level.boxes.size())});
  const int ghosts = 3;
  Warehouse state(level, 0, Arrays::shared);
  const int slot = state.add({test_label(0), 0, 1, ghosts});
  for (int b = 0; b < 4; ++b) {
    const RealView v = state.view(slot, 0, b);
    fill(v, v.box, untouched);
  }
  for (int b = 0; b < 4; ++b)
    for_each_cell(level.boxes[b].cells,
                  [&](IntVec3 cell) { state.view(slot, 0, b)(cell) = value_of(slot, 0, cell); });
  HaloExchange(level, ghosts, 0, Arrays::shared).run(state, {slot});
  const auto held = [&](IntVec3 cell) {
    for (const GridBox& box : level.boxes)
      if (box.cells.contains(cell)) return true;
    return false;
  };
  for (int b = 0; b < 4; ++b) {
    const RealView v = state.view(slot, 0, b);
    for_each_cell(v.box, [&](IntVec3 cell) {
      ASSERT_EQ(v(cell), held(cell) ? value_of(slot, 0, cell) : untouched) << b;
    });
  }
}

TEST(Halo, CopiesAreTheSameListOnEveryRankAndCoverEachGhostOnce) {
  Level level = level_of({9, 12, 1}, {2, 3, 1});
  level.periodic = {true, true, false};
  const std::vector<HaloCopy> copies = halo_copies(level, 3);
  for (const GridBox& box : level.boxes) {
    std::int64_t ghosts = 0;
    for (const HaloCopy& c : copies) {
      if (c.to != box.id) continue;
      EXPECT_TRUE(level.boxes[c.from].cells.contains(c.region.shifted(c.shift)));
      EXPECT_TRUE(intersection(c.region, box.cells).empty());
      ghosts += c.region.volume();
    }
    EXPECT_EQ(ghosts, box.cells.grown({3, 3, 0}).volume() - box.cells.volume());
  }
}

TEST(Halo, OneMessageANeighbourRankAndItsSize) {
  Level level = level_of({40, 4, 1}, {4, 1, 1});
  for (std::size_t b = 0; b < 4; ++b) level.boxes[b].owner = static_cast<int>(b) % 2;
  const HaloExchange halo(level, 3, 0);  // boxes 0 and 2 here, 1 and 3 elsewhere
  EXPECT_EQ(halo.neighbour_ranks(), 1);
  EXPECT_EQ(halo.message_bytes(5), 3u * 3u * 4u * 5u * sizeof(double));
}

}  // namespace
}  // namespace sluice::halo_test
