// The Tiled regridder: what is refined, nesting, triggers, deletion, restart, speed.
#include "framework/refine/regridder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/grid/grid_boxes.hpp"

namespace sluice::regridder_test {
namespace {

struct Case {
  RefinementSettings settings;
  std::vector<Level> levels;
  Regridder regridder() const { return {settings, levels, 1, 1}; }
  std::vector<FlagField> flags(int count) const {
    std::vector<FlagField> f;
    for (int l = 0; l < count; ++l) f.emplace_back(levels[l].domain);
    return f;
  }
};

Case make_case(IntVec3 coarse, int levels, IntVec3 ratio, IntVec3 tile,
               std::array<bool, 3> periodic = {}) {
  Case c;
  c.settings.adaptive = true;
  c.settings.max_levels = levels;
  c.settings.max_interval = 0;
  IntVec3 mask{};
  for (int d = 0; d < 3; ++d) mask[d] = coarse[d] > 1 ? 1 : 0;
  c.settings.stability_dilation = c.settings.min_boundary_cells = mask;
  c.settings.deletion_dilation = mask;
  c.settings.tile.assign(levels, tile);
  IndexBox domain{{0, 0, 0}, coarse};
  for (int l = 0; l < levels; ++l) {
    Level level;
    level.index = l;
    if (l > 0) {
      level.ratio = ratio;
      domain = refine(domain, ratio);
    }
    level.domain = domain;
    level.periodic = periodic;
    if (l == 0) level.boxes = {{domain, 0, 0}};
    c.levels.push_back(level);
  }
  return c;
}

// Each level lies inside the coarser one with the margin that was asked for.
void expect_nested(const Case& c, const Regridder& r) {
  for (std::size_t l = 2; l < c.levels.size(); ++l) {
    const BoxFinder below(cells_of(r.boxes(static_cast<int>(l) - 1)));
    const Level& around = c.levels[l - 1];
    for (const IndexBox& b : cells_of(r.boxes(static_cast<int>(l)))) {
      const IndexBox margin = coarsen(b, c.levels[l].ratio).grown(c.settings.min_boundary_cells);
      for_each_cell({IntVec3::all(-1), IntVec3::all(2)}, [&](IntVec3 image) {
        for (int d = 0; d < 3; ++d)
          if (image[d] != 0 && !around.periodic[d]) return;
        const IndexBox part =
            intersection(margin.shifted(image * around.domain.size()), around.domain);
        EXPECT_TRUE(part.empty() || below.covers(part)) << "level " << l;
      });
    }
  }
}

TEST(Regridder, TilesAroundAFlag) {
  const Case c = make_case({32, 32, 1}, 2, {4, 4, 1}, {8, 8, 1});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  EXPECT_FALSE(r.regrid(1, flags));
  flags[0].set(IntVec3{10, 20, 0});  // with one cell around it: 9..11, 19..21
  EXPECT_TRUE(r.regrid(2, flags));
  EXPECT_EQ(r.state().tiles[1].tiles,
            (std::vector<IntVec3>{{4, 9, 0}, {5, 9, 0}, {4, 10, 0}, {5, 10, 0}}));
  EXPECT_EQ(cells_of(r.boxes(1)), (std::vector<IndexBox>{{{32, 72, 0}, {48, 88, 1}}}));
  EXPECT_EQ(r.cells(1), 256);
  EXPECT_EQ(r.tile_cells(1, {4, 9, 0}), (IndexBox{{32, 72, 0}, {40, 80, 1}}));
  EXPECT_EQ(r.state().last_step, 2);
  EXPECT_FALSE(r.regrid(3, flags));  // covered
  EXPECT_EQ(r.cells(0), 1024);
}

TEST(Regridder, StabilityDecidesWhenAndRegridDilationWhat) {
  Case c = make_case({64, 1, 1}, 2, {2, 1, 1}, {4, 1, 1});
  c.settings.regrid_dilation = {3, 0, 0};
  Regridder r = c.regridder();
  auto at = [&](int x) {
    auto flags = c.flags(1);
    flags[0].set(IntVec3{x, 0, 0});
    return flags;
  };
  EXPECT_TRUE(r.regrid(1, at(20)));  // 16..24 and whole tiles of two cells
  EXPECT_EQ(cells_of(r.boxes(1)), (std::vector<IndexBox>{{{32, 0, 0}, {52, 1, 1}}}));
  EXPECT_FALSE(r.regrid(2, at(24)));  // up to 25 is covered
  EXPECT_TRUE(r.regrid(3, at(25)));
}

TEST(Regridder, LevelsNestWithAMargin) {
  for (const IntVec3& ratio : {IntVec3{2, 2, 1}, IntVec3{4, 4, 1}, IntVec3{4, 2, 1}})
    for (const bool periodic : {false, true})
      for (const int margin : {1, 2, 5}) {
        Case c = make_case({30, 22, 1}, 4, ratio, {8, 8, 1}, {periodic, periodic, false});
        c.settings.min_boundary_cells = {margin, margin, 0};
        Regridder r = c.regridder();
        auto flags = c.flags(3);
        const IntVec3 n = c.levels[2].domain.size();
        flags[2].set(IntVec3{0, n.y / 3, 0});  // at the boundary, on the finest flagged level only
        flags[2].set(IntVec3{n.x / 2, n.y - 1, 0});
        EXPECT_TRUE(r.regrid_at_start(flags));
        EXPECT_GT(r.cells(3), 0);
        EXPECT_GT(r.cells(1) * ratio.x * ratio.y, r.cells(2));
        expect_nested(c, r);
        EXPECT_FALSE(r.regrid_at_start(flags));
      }
}

TEST(Regridder, WrapsAroundPeriodicSides) {
  const Case c = make_case({16, 16, 1}, 2, {2, 2, 1}, {4, 4, 1}, {true, false, false});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  flags[0].set(IntVec3{0, 0, 0});
  EXPECT_TRUE(r.regrid(1, flags));
  EXPECT_EQ(r.state().tiles[1].tiles, (std::vector<IntVec3>{{0, 0, 0}, {7, 0, 0}}));
}

TEST(Regridder, ThreeDimensionsAndEverywhere) {
  const Case c = make_case({12, 12, 12}, 3, {2, 2, 2}, {8, 8, 8});
  Regridder r = c.regridder();
  auto flags = c.flags(2);
  flags[1].set(IntVec3{0, 0, 23});
  EXPECT_TRUE(r.regrid(1, flags));
  expect_nested(c, r);
  for (FlagField& f : flags) f.fill(f.domain());
  EXPECT_TRUE(r.regrid(2, flags));
  for (int l = 1; l < 3; ++l)
    EXPECT_EQ(cells_of(r.boxes(l)), (std::vector<IndexBox>{c.levels[l].domain}));
}

TEST(Regridder, BoxesCanBeLimited) {
  const Case c = make_case({32, 32, 1}, 2, {2, 2, 1}, {8, 8, 1});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  flags[0].fill({{4, 4, 0}, {28, 20, 1}});
  ASSERT_TRUE(r.regrid(1, flags));
  ASSERT_EQ(r.boxes(1).size(), 1u);
  const IndexBox whole = r.boxes(1)[0].cells;
  for (const std::int64_t most : {300, 64, 1}) {
    r.limit_boxes(most);
    const std::vector<GridBox> boxes = r.boxes(1);
    EXPECT_TRUE(BoxFinder(cells_of(boxes)).covers(whole));
    for (const GridBox& b : boxes) EXPECT_LE(b.cells.volume(), std::max<std::int64_t>(most, 64));
  }
  EXPECT_EQ(static_cast<std::int64_t>(r.boxes(1).size()), whole.volume() / 64);
}

TEST(Regridder, OneTileIsALevelToo) {
  const Case c = make_case({6, 5, 1}, 2, {2, 2, 1}, {16, 16, 1});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  flags[0].set(IntVec3{2, 2, 0});
  EXPECT_TRUE(r.regrid(1, flags));
  EXPECT_EQ(cells_of(r.boxes(1)), (std::vector<IndexBox>{c.levels[1].domain}));
}

TEST(Regridder, LockstepDividesTheRegridDilation) {
  Case c = make_case({64, 1, 1}, 4, {4, 1, 1}, {4, 1, 1});
  c.settings.regrid_dilation = {9, 0, 0};
  const auto width = [&](bool lock_step, int existing) {
    c.settings.lock_step = lock_step;
    Regridder r = c.regridder();
    auto flags = c.flags(existing);
    flags[0].set(IntVec3{30, 0, 0});
    r.regrid(1, flags);
    return r.cells(1) / 4;  // tiles of one coarse cell
  };
  EXPECT_EQ(width(false, 3), 21);
  EXPECT_EQ(width(true, 3), 5);  // 9 / 16, rounded up
  EXPECT_EQ(width(true, 2), 9);  // 9 / 4: the next finer level does not exist
  EXPECT_EQ(width(true, 4), 5);  // the finest level asks for nothing
  EXPECT_EQ(width(true, 1), 21);
}

TEST(Regridder, IntervalsAreKept) {
  Case c = make_case({32, 1, 1}, 2, {2, 1, 1}, {4, 1, 1});
  c.settings.min_interval = 3;
  c.settings.max_interval = 5;
  Regridder r = c.regridder();
  EXPECT_FALSE(r.looks_at(0));
  EXPECT_FALSE(r.looks_at(2));
  EXPECT_TRUE(r.looks_at(3));
  auto flags = c.flags(1);
  EXPECT_FALSE(r.regrid(5, flags));
  EXPECT_EQ(r.state().last_step, 0);
  EXPECT_FALSE(r.regrid(6, flags));  // the interval ran out; nothing changes
  EXPECT_EQ(r.state().last_step, 6);
  EXPECT_FALSE(r.looks_at(8));
  EXPECT_TRUE(r.looks_at(9));
  c.settings.once = true;
  EXPECT_FALSE(c.regridder().looks_at(100));
  c.settings.adaptive = false;
  EXPECT_FALSE(c.regridder().adaptive());
  EXPECT_FALSE(c.regridder().looks_at(100));
}

TEST(Regridder, WhatIsNoLongerAskedForGoesWhenItHasCostAStep) {
  const Case c = make_case({40, 1, 1}, 2, {2, 1, 1}, {4, 1, 1});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  flags[0].set(IntVec3{20, 0, 0});
  ASSERT_TRUE(r.regrid(1, flags));
  ASSERT_EQ(r.cells(1), 8);  // 16 updates per coarse step, of 56 in all
  const auto none = c.flags(1);
  int step = 2;
  while (!r.regrid(step, none) && step < 50) ++step;
  EXPECT_EQ(step, 5);  // 4 * 16 >= 56, at the fourth look
  EXPECT_EQ(r.cells(1), 0);
  EXPECT_TRUE(r.boxes(1).empty());
  EXPECT_TRUE(r.state().idle[1].empty());
}

TEST(Regridder, FlagsThatComeAndGoKeepTheirTiles) {
  const Case c = make_case({40, 1, 1}, 2, {2, 1, 1}, {4, 1, 1});
  Regridder r = c.regridder();
  auto flags = c.flags(1);
  flags[0].set(IntVec3{20, 0, 0});
  const auto none = c.flags(1);
  ASSERT_TRUE(r.regrid(1, flags));
  for (int step = 2; step < 200; ++step)
    EXPECT_FALSE(r.regrid(step, step % 4 == 0 ? flags : none)) << step;
  EXPECT_EQ(r.cells(1), 8);
}

TEST(Regridder, DeletionDilationKeepsTilesNearFlags) {
  Case c = make_case({40, 1, 1}, 2, {2, 1, 1}, {4, 1, 1});
  c.settings.max_interval = 10;
  for (const int reach : {0, 4}) {
    c.settings.deletion_dilation = {reach, 0, 0};
    Regridder r = c.regridder();
    auto flags = c.flags(1);
    flags[0].fill({{10, 0, 0}, {16, 1, 1}});
    ASSERT_TRUE(r.regrid(1, flags));
    ASSERT_EQ(r.cells(1), 20);  // 8 .. 17
    flags = c.flags(1);
    flags[0].fill({{10, 0, 0}, {11, 1, 1}});  // asks for 9 .. 11, kept as far as 11 + reach
    for (int step = 2; step < 30; ++step) r.regrid(step, flags);
    EXPECT_EQ(r.cells(1), reach == 0 ? 8 : 16);
  }
}

TEST(Regridder, GoesOnFromItsState) {
  Case c = make_case({64, 48, 1}, 3, {2, 2, 1}, {8, 8, 1});
  c.settings.max_interval = 7;
  const auto flags_at = [&](int step) {  // a ring that grows and vanishes
    auto flags = c.flags(2);
    for (std::size_t l = 0; l < 2; ++l)
      for_each_cell(flags[l].domain(), [&](IntVec3 cell) {
        const double s = l == 0 ? 1 : 0.5;
        const double radius = std::hypot(s * (cell.x + 0.5) - 32, s * (cell.y + 0.5) - 24);
        if (std::abs(radius - 0.8 * step) < 1 && step < 40) flags[l].set(cell);
      });
    return flags;
  };
  Regridder whole = c.regridder(), other = c.regridder();
  int regrids = 0;
  for (int step = 1; step < 60; ++step) {
    const bool looks = whole.looks_at(step);
    ASSERT_EQ(other.looks_at(step), looks);
    if (looks) {
      const bool changed = whole.regrid(step, flags_at(step));
      regrids += changed;
      ASSERT_EQ(other.regrid(step, flags_at(step)), changed);
    }
    ASSERT_EQ(other.state(), whole.state());
    expect_nested(c, whole);
    Regridder restarted(c.settings, c.levels, 3, 2);
    restarted.restore(regrid_state_from_json_text(to_json_text(whole.state())));
    other = restarted;
  }
  EXPECT_GT(regrids, 5);
  EXPECT_LT(regrids, 50);
  EXPECT_EQ(whole.cells(1), 0);
}

TEST(Regridder, RefusesAForeignState) {
  const Case c = make_case({32, 32, 1}, 2, {2, 2, 1}, {8, 8, 1});
  Regridder r = c.regridder();
  RegridState state = r.state();
  state.tiles[1].tiles = {{8, 0, 0}};
  state.idle[1] = {0};
  EXPECT_THROW(r.restore(state), InputError);
  state.tiles.pop_back();
  EXPECT_THROW(r.restore(state), InputError);
}

TEST(Regridder, MirroredFlagsGiveMirroredTiles) {
  const Case c = make_case({31, 26, 1}, 3, {2, 2, 1}, {12, 8, 1});
  Regridder r = c.regridder(), m = c.regridder();
  auto flags = c.flags(2), mirrored = c.flags(2);
  for (std::size_t l = 0; l < 2; ++l)
    for (int n = 0; n < 5; ++n) {
      const IntVec3 cell{3 + 4 * n, 2 + n * n, 0};
      flags[l].set(cell);
      mirrored[l].set(IntVec3{c.levels[l].domain.upper.x - 1 - cell.x, cell.y, 0});
    }
  ASSERT_TRUE(r.regrid(1, flags));
  ASSERT_TRUE(m.regrid(1, mirrored));
  for (int l = 1; l < 3; ++l) {
    const int end = c.levels[l].domain.upper.x;
    const BoxFinder there(cells_of(m.boxes(l)));
    EXPECT_EQ(m.cells(l), r.cells(l));
    for (const IndexBox& b : cells_of(r.boxes(l)))
      EXPECT_TRUE(there.covers({{end - b.upper.x, b.lower.y, 0}, {end - b.lower.x, b.upper.y, 1}}));
  }
}

// A look at the flags of a 512 x 512 level, tiles of 2 x 2 of its cells: a ring, and everything.
TEST(Regridder, LooksAtLargeLevels) {
  const Case c = make_case({512, 512, 1}, 2, {4, 4, 1}, {8, 8, 1});
  for (const bool everything : {false, true}) {
    auto flags = c.flags(1);
    const IndexBox domain = flags[0].domain();
    for_each_cell(domain, [&](IntVec3 cell) {
      if (everything || std::abs(std::hypot(cell.x - 256, cell.y - 256) - 150) < 3)
        flags[0].set(cell);
    });
    Regridder r = c.regridder();
    ASSERT_TRUE(r.regrid(1, flags));
    const BoxFinder there(cells_of(r.boxes(1)));
    for_each_cell(domain, [&](IntVec3 cell) {
      const IndexBox fine = refine(IndexBox{cell, cell + IntVec3{1, 1, 1}}, {4, 4, 1});
      EXPECT_TRUE(!flags[0].get(cell) || there.covers(fine));
    });
    const std::int64_t all = 16 * domain.volume();
    EXPECT_LE(r.cells(1), everything ? all : all / 10);
  }
}

}  // namespace
}  // namespace sluice::regridder_test
