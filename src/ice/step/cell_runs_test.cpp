// Runs of cells against the geometry itself.
#include "ice/step/cell_runs.hpp"

#include <gtest/gtest.h>

#include "framework/geometry/boolean.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/round.hpp"

namespace sluice::ice::cell_runs_test {
namespace {

Level level(std::array<bool, 3> active) {
  Level l;
  l.anchor = {-1, -0.5, 0.25};
  l.spacing = {0.125, 0.1, 0.0625};
  l.domain = {{0, 0, 0}, {active[0] ? 16 : 1, active[1] ? 13 : 1, active[2] ? 7 : 1}};
  l.active = active;
  return l;
}

// Every cell of the domain and some outside.
void expect_same(const GeometryPiece& piece, const Level& l) {
  const CellRuns region(piece, l);
  int inside = 0;
  for_each_cell(l.domain.grown(IntVec3::all(1)), [&](IntVec3 c) {
    const bool wanted = l.domain.contains(c) && piece.inside(l.centre(c));
    EXPECT_EQ(region.contains(c), wanted) << c.x << ' ' << c.y << ' ' << c.z;
    inside += wanted ? 1 : 0;
  });
  if (l.active_count() == 3) {
    EXPECT_GT(inside, 0);
  }
}

TEST(CellRuns, HoldsTheCellsWhoseCentresAreInside) {
  const SpherePiece ball({-0.2, 0.1, 0.4}, 0.45);
  const DifferencePiece shell(std::make_shared<SpherePiece>(Vec3{0, 0, 0.4}, 0.6),
                              std::make_shared<SpherePiece>(Vec3{0, 0, 0.4}, 0.3));
  const BoxPiece beyond({-9, -9, -9}, {0.3, 0.2, 9});
  for (const GeometryPiece* piece :
       {static_cast<const GeometryPiece*>(&ball), static_cast<const GeometryPiece*>(&shell),
        static_cast<const GeometryPiece*>(&beyond)})
    for (const std::array<bool, 3> active :
         {std::array{true, true, true}, {true, true, false}, {false, true, true}})
      expect_same(*piece, level(active));
}

TEST(CellRuns, OfAPieceOutsideTheDomainIsEmpty) {
  const BoxPiece far({5, 5, 5}, {6, 6, 6});
  const CellRuns region(far, level({true, true, true}));
  EXPECT_TRUE(region.runs({0, 0, 0}).empty());
  EXPECT_TRUE(region.runs({3, 4, 5}).empty());
}

TEST(CellRuns, JoinsNeighboursIntoRuns) {
  const EverywherePiece all;
  const Level l = level({true, true, true});
  const CellRuns region(all, l);
  ASSERT_EQ(region.runs({5, 3, 2}).size(), 1u);
  EXPECT_EQ(region.runs({5, 3, 2})[0].first, 0);
  EXPECT_EQ(region.runs({5, 3, 2})[0].end, 16);
}

}  // namespace
}  // namespace sluice::ice::cell_runs_test
