// Levels and boxes from the deck, every fault of a grid, and the Grid built for ranks.
#include "framework/scene/grid_settings.hpp"

#include <set>

#include "framework/base/error.hpp"
#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::grid_settings_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Read {
  GridSettings settings;
  std::string faults;
};

Read read(const std::string& levels) {
  const DeckText deck("<Grid>" + levels + "</Grid>");
  std::vector<Fault> faults;
  Read r;
  r.settings = read_grid_settings(deck.first(), faults);
  r.faults = all_faults(faults);
  return r;
}

std::string box(const std::string& lower, const std::string& upper, const std::string& more) {
  return "<Box><lower>" + lower + "</lower><upper>" + upper + "</upper>" + more + "</Box>";
}
std::string resolution(const std::string& r) {
  return "<resolution>" + r + "</resolution>";
}

// Every cell of the level belongs to exactly one box.
void expect_partition(const Level& level) {
  std::int64_t cells = 0;
  for (std::size_t i = 0; i < level.boxes.size(); ++i) {
    cells += level.boxes[i].cells.volume();
    EXPECT_EQ(level.boxes[i].id, static_cast<int>(i));
    EXPECT_TRUE(level.domain.contains(level.boxes[i].cells));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(intersection(level.boxes[i].cells, level.boxes[j].cells).empty());
  }
  EXPECT_EQ(cells, level.domain.volume());
}

TEST(GridSettings, OneBoxByResolutionOrBySpacing) {
  const Read a = read("<Level>" +
                      box("[-1,0,0]", "[1,1,0.1]",
                          resolution("[20,5,1]") + "<extraCells>[1,1,1]</extraCells>" +
                              "<patches>[4,1,1]</patches>") +
                      "<periodic>[0,1,0]</periodic></Level>");
  ASSERT_EQ(a.faults, "");
  const Grid grid = build_grid(a.settings, {});
  ASSERT_EQ(grid.levels.size(), 1u);
  const Level& level = grid.levels[0];
  EXPECT_EQ(level.anchor, (Vec3{-1, 0, 0}));
  EXPECT_EQ(level.spacing, (Vec3{0.1, 0.2, 0.1}));
  EXPECT_EQ(level.domain, (IndexBox{{0, 0, 0}, {20, 5, 1}}));
  EXPECT_EQ(level.periodic, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(level.boxes.size(), 4u);
  expect_partition(level);
  EXPECT_EQ(a.settings.levels[0].boxes[0].extra_cells, (IntVec3{1, 1, 1}));

  const Read b = read("<Level>" + box("[-1,0,0]", "[1,1,0.1]", "") +
                      "<spacing>[0.1,0.2,0.1]</spacing></Level>");
  ASSERT_EQ(b.faults, "");
  EXPECT_EQ(build_grid(b.settings, {}).levels[0].domain, level.domain);
  EXPECT_EQ(build_grid(b.settings, {}).levels[0].spacing, level.spacing);
}

TEST(GridSettings, SeveralBoxesShareOneAnchorAndSpacing) {
  const Read r = read("<Level>" + box("[1,0,0]", "[3,1,1]", resolution("[4,2,2]")) +
                      box("[0,0,0]", "[1,1,1]", resolution("[2,2,2]")) + "</Level>");
  ASSERT_EQ(r.faults, "");
  const Level level = build_grid(r.settings, {}).levels[0];
  EXPECT_EQ(level.anchor, (Vec3{0, 0, 0}));
  EXPECT_EQ(level.domain, (IndexBox{{0, 0, 0}, {6, 2, 2}}));
  EXPECT_EQ(level.boxes[0].cells, (IndexBox{{2, 0, 0}, {6, 2, 2}}));
  expect_partition(level);
}

TEST(GridSettings, AFinerLevelHasTheIndicesOfItsPlace) {
  const Read r = read("<Level>" + box("[-2,-2,0]", "[2,2,1]", resolution("[8,8,1]")) + "</Level>" +
                      "<Level>" + box("[-1,0,0]", "[1,1,1]", resolution("[8,4,1]")) + "</Level>");
  ASSERT_EQ(r.faults, "");
  const Grid grid = build_grid(r.settings, {});
  ASSERT_EQ(grid.levels.size(), 2u);
  EXPECT_EQ(grid.levels[1].ratio, (IntVec3{2, 2, 1}));
  EXPECT_EQ(grid.levels[1].boxes[0].cells, (IndexBox{{4, 8, 0}, {12, 12, 1}}));
  EXPECT_EQ(grid.levels[1].domain, (IndexBox{{0, 0, 0}, {16, 16, 1}}));
  EXPECT_EQ(grid.levels[1].centre({4, 8, 0}), (Vec3{-0.875, 0.125, 0.5}));
}

TEST(GridSettings, Faults) {
  const std::string one = resolution("[10,1,1]");
  struct Case {
    std::string levels, message;
  };
  const std::vector<Case> cases = {
      {"", "at least one <Level>"},
      {"<Level></Level>", "at least one <Box>"},
      {"<Level>" + box("[0,0,0]", "[-1,1,1]", one) + "</Level>", "upper -1 is not above lower 0"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", "") + "</Level>", "a box needs a <resolution>"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one + "<spacing>[1,1,1]</spacing>") + "</Level>",
       "not both"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", resolution("[0,1,1]")) + "</Level>", "0 cells"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", "<spacing>[0.3,1,1]</spacing>") + "</Level>",
       "3.3333333333333335 cells in direction x; it ends with the last complete cell, at 0.9"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", "<spacing>[0,1,1]</spacing>") + "</Level>",
       "cells in direction x"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", resolution("[10000,10000,10000]")) + "</Level>",
       "1e+12 cells"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one + "<patches>[1,2,1]</patches>") + "</Level>",
       "2 patches but only 1 cells in direction y"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one + "<patches>[0,1,1]</patches>") + "</Level>",
       "0 patches"},
      {"<Level>" +
           box("[0,0,0]", "[1,1,1]",
               resolution("[2000,2000,2000]") + "<patches>[2000,2000,2000]</patches>") +
           "</Level>",
       "8e+09 patches"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) +
           box("[1,0,0]", "[2,1,1]", resolution("[9,1,1]")) + "</Level>",
       "share one spacing"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + box("[0.95,0,0]", "[1.95,1,1]", one) +
           "</Level>",
       "not on a node"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + box("[0.5,0,0]", "[1.5,1,1]", one) + "</Level>",
       "overlaps the box at deck.ups"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + box("[2,0,0]", "[3,1,1]", one) + "</Level>",
       "leave gaps"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + "</Level><Level>" +
           box("[0,0,0]", "[1,1,1]", resolution("[15,1,1]")) + "</Level>",
       "refinement ratio 1.5"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + "</Level><Level>" +
           box("[0.05,0,0]", "[0.55,1,1]", resolution("[10,1,1]")) + "</Level>",
       "not on nodes of the coarser level"},
      {"<Level>" + box("[0,0,0]", "[1,1,1]", one) + "</Level><Level>" +
           box("[0.5,0,0]", "[1.5,1,1]", resolution("[20,1,1]")) + "</Level>",
       "extends beyond the next coarser level"},
  };
  for (const Case& c : cases) {
    const Read r = read(c.levels);
    EXPECT_THAT(r.faults, HasSubstr(c.message)) << c.levels;
    EXPECT_THAT(r.faults, HasSubstr("deck.ups:")) << c.levels;
  }
}

GridSettings plain(const std::string& cells, const std::string& more) {
  return read("<Level>" + box("[0,0,0]", "[1,1,1]", resolution(cells) + more) + "</Level>")
      .settings;
}

TEST(BuildGrid, RanksEachGetBoxes) {
  const GridSettings settings = plain("[32,32,1]", "");
  for (int ranks : {1, 2, 3, 4, 7, 16}) {
    GridOptions options;
    options.ranks = ranks;
    const Level level = build_grid(settings, options).levels[0];
    expect_partition(level);
    std::set<int> owners;
    for (const GridBox& b : level.boxes) owners.insert(b.owner);
    EXPECT_EQ(owners.size(), static_cast<std::size_t>(ranks)) << ranks;
    EXPECT_EQ(*owners.rbegin(), ranks - 1);
  }
}

TEST(BuildGrid, TheMiddleOfEqualDirectionsIsCutFirst) {
  for (const auto& [ranks, size] :
       std::vector<std::pair<int, IntVec3>>{{2, {8, 4, 8}}, {4, {8, 4, 4}}, {8, {4, 4, 4}}}) {
    GridOptions options;
    options.ranks = ranks;
    const Level level = build_grid(plain("[8,8,8]", ""), options).levels[0];
    for (const GridBox& b : level.boxes) EXPECT_EQ(b.cells.size(), size) << ranks;
  }
}

TEST(BuildGrid, DeckPatchesStayWhereTheyAreEnough) {
  GridOptions options;
  options.ranks = 3;
  const Level level = build_grid(plain("[8,8,1]", "<patches>[2,2,1]</patches>"), options).levels[0];
  EXPECT_EQ(level.boxes.size(), 4u);
  EXPECT_EQ(level.boxes[1].cells, (IndexBox{{0, 4, 0}, {4, 8, 1}}));
}

TEST(BuildGrid, AutoPatchCutsTheLongDirections) {
  GridOptions options;
  options.ranks = 2;
  const Level level = build_grid(plain("[64,16,1]", "<autoPatch>4</autoPatch>"), options).levels[0];
  EXPECT_EQ(level.boxes.size(), 8u);
  expect_partition(level);
  const Level flat =
      build_grid(plain("[64,16,1]", "<autoPatch flatten=\"[1,0,0]\">4</autoPatch>"), options)
          .levels[0];
  for (const GridBox& b : flat.boxes) EXPECT_EQ(b.cells.size().x, 64);
}

TEST(BuildGrid, AForcedSplitOverridesTheDeck) {
  GridOptions options;
  options.boxes = {3, 2, 1};
  const GridSettings settings = plain("[8,8,1]", "<patches>[2,2,1]</patches>");
  const Level level = build_grid(settings, options).levels[0];
  EXPECT_EQ(level.boxes.size(), 6u);
  expect_partition(level);
  options.boxes = {2000, 2000, 1};
  EXPECT_THAT([&] { build_grid(plain("[2000,2000,1]", ""), options); },
              ThrowsMessage<InputError>(HasSubstr("at most a million boxes")));
  options.boxes = {1, 1, 2};
  EXPECT_THAT([&] { build_grid(settings, options); },
              ThrowsMessage<InputError>(HasSubstr("8 x 8 x 1 cells")));
}

TEST(BuildGrid, FinerLevelsAreCutAsRanksNeedBetweenCoarseCells) {
  const std::string coarse =
      "<Level>" + box("[0,0,0]", "[1,1,1]", resolution("[8,8,1]")) + "</Level>";
  const std::string fine =
      "<Level>" +
      box("[0,0,0]", "[0.375,0.375,1]", resolution("[12,12,1]") + "<patches>[6,6,1]</patches>") +
      box("[0.5,0.5,0]", "[0.625,0.625,1]", resolution("[4,4,1]")) + "</Level>";
  const Read r = read(coarse + fine);
  ASSERT_EQ(r.faults, "");
  for (const int ranks : {1, 2, 3, 8}) {
    GridOptions options;
    options.ranks = ranks;
    const Level level = build_grid(r.settings, options).levels[1];
    EXPECT_EQ(level.cell_count(), 160);
    EXPECT_GE(level.boxes.size(), static_cast<std::size_t>(std::max(2, ranks)));
    std::set<int> owners;
    for (const GridBox& b : level.boxes) {
      owners.insert(b.owner);
      EXPECT_FALSE(b.cells.empty());
      for (int d = 0; d < 2; ++d) {
        EXPECT_EQ(b.cells.lower[d] % 4, 0);
        EXPECT_EQ(b.cells.upper[d] % 4, 0);
      }
    }
    EXPECT_EQ(owners.size(), static_cast<std::size_t>(ranks));
    // The deck's patches are merged.
    EXPECT_TRUE(ranks > 1 || level.boxes.size() == 2u);
  }
  GridOptions forced;
  forced.boxes = {2, 5, 1};
  const Level level = build_grid(r.settings, forced).levels[1];
  EXPECT_EQ(level.boxes.size(), 2u * 3u + 1u);  // no more pieces than coarse cells
}

TEST(BuildGrid, MoreRanksThanCellsIsRefused) {
  GridOptions options;
  options.ranks = 9;
  EXPECT_THAT([&] { build_grid(plain("[8,1,1]", ""), options); },
              ThrowsMessage<InputError>(HasSubstr("9 ranks")));
}

TEST(BuildGrid, InactiveDirectionsReachTheLevels) {
  GridOptions options;
  options.active = {true, false, false};
  const Level level = build_grid(plain("[8,1,1]", ""), options).levels[0];
  EXPECT_EQ(level.active_count(), 1);
  EXPECT_EQ(level.ghosts(3), (IntVec3{3, 0, 0}));
}

}  // namespace
}  // namespace sluice::grid_settings_test
