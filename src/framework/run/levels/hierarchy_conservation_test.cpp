// What levels that come, move and go must keep: masses, zeros, memory.
#include <gmock/gmock.h>

#include <cmath>

#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_conservation_test {
namespace {

using namespace hierarchy_test;

class Keeping : public OnLevels {};

// A spot that circles through the domain, at each level narrower.
Wishes moving_spot(const IntVec3& cells) {
  Wishes w;
  w.velocity_a = {0.25, 0.125, 0.0625};
  w.velocity_b = {0.125, 0.25, 0.125};
  w.diffusion = 0.015625;
  w.start = [](Vec3 x) {
    return Values{2 + std::sin(3 * x.x + x.z), 1 + std::cos(2 * x.y), 1 + std::sin(x.x + 2 * x.y)};
  };
  w.flagged = [cells](Vec3 x, double t) {
    double r2 = 0;
    for (int d = 0; d < 3; ++d) {
      if (cells[d] == 1) continue;
      const double centre = cells[d] * (0.5 + 0.35 * std::sin(0.9 * t + d));
      r2 += (x[d] - centre) * (x[d] - centre);
    }
    return r2 < 2.2;
  };
  return w;
}

void expect_kept(const Values& before, const Values& after) {
  for (std::size_t q = 0; q < quantities; ++q)
    EXPECT_NEAR(after[q], before[q], 1e-14 * before[q]) << "quantity " << q;
}

struct Way {
  IntVec3 cells;
  std::vector<int> ratios;
  bool lock_step = false;
  double dt = 0.5;
};

class KeepingOnAnyLevels : public OnLevels, public testing::WithParamInterface<Way> {};

TEST_P(KeepingOnAnyLevels, AllMassesThroughStepsAndRegrids) {
  const Way way = GetParam();
  Shape shape;
  shape.cells = way.cells;
  shape.ratios = way.ratios;
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 4});
  scene.refinement.lock_step = way.lock_step;
  const Wishes w = moving_spot(way.cells);
  LevelRun run(scene, w);
  ASSERT_EQ(run.hierarchy.level_count(), static_cast<int>(way.ratios.size()) + 1);
  const Values before = run.totals();
  const States start = run.states();
  run.advance(24, way.dt);
  EXPECT_GT(run.hierarchy.regridding().count(), 3);
  expect_kept(before, run.totals());
  for (const CellState& s : run.states())
    for (const double v : s.values) EXPECT_GE(v, 0);
}

INSTANTIATE_TEST_SUITE_P(Ways, KeepingOnAnyLevels,
                         testing::Values(Way{{64, 1, 1}, {2}}, Way{{64, 1, 1}, {4, 2}},
                                         Way{{16, 16, 1}, {2}}, Way{{16, 16, 1}, {4}},
                                         Way{{16, 16, 1}, {2, 2}}, Way{{16, 16, 1}, {2, 4}},
                                         Way{{16, 16, 1}, {2, 4}, true, 0.0625},
                                         Way{{12, 12, 12}, {2}}, Way{{1, 16, 16}, {4}}),
                         [](const testing::TestParamInfo<Way>& way) {
                           std::string name = "Cells";
                           for (int d = 0; d < 3; ++d)
                             name += "_" + std::to_string(way.param.cells[d]);
                           name += "_Ratios";
                           for (const int r : way.param.ratios) name += "_" + std::to_string(r);
                           return name + (way.param.lock_step ? "_Lockstep" : "");
                         });

TEST_F(Keeping, MassesWhenLevelsVanishAndComeBack) {
  Wishes w = moving_spot({16, 16, 1});
  const auto always = w.flagged;
  w.flagged = [&](Vec3 x, double t) { return std::fmod(t, 8) < 4 && always(x, t); };
  Shape shape;
  shape.ratios = {2, 2};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  LevelRun run(scene, w);
  const Values before = run.totals();
  int changes = 0, levels = run.hierarchy.level_count();
  EXPECT_EQ(levels, 3);
  for (int n = 0; n < 48; ++n) {
    run.advance(1, 0.5);
    if (run.hierarchy.level_count() == levels) continue;
    levels = run.hierarchy.level_count();
    ++changes;
  }
  EXPECT_GE(changes, 5);  // gone and back, three times
  expect_kept(before, run.totals());
}

TEST_F(Keeping, UniformStatesToTheBitThroughMovingLevels) {
  Wishes w = moving_spot({16, 16, 1});
  w.start = [](Vec3) { return Values{1.5, 0.75, 0.5}; };
  w.diffusion = 0;
  Shape shape;
  shape.ratios = {2, 4};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  LevelRun run(scene, w);
  run.advance(20, 0.5);
  EXPECT_GT(run.hierarchy.regridding().count(), 3);
  for (const CellState& s : run.states())
    EXPECT_EQ(s.values, (Values{1.5, 0.75, 0.5})) << "level " << s.level;
}

// A material at rest in part of the domain: where it is not, it is not, whatever levels do.
TEST_F(Keeping, NothingWhereAMaterialIsNot) {
  Wishes w = moving_spot({16, 16, 1});
  const auto there = [](Vec3 x) { return x.x > 4 && x.x < 8 && x.y > 4 && x.y < 12; };
  w.velocity_b = {};
  w.start = [&](Vec3 x) { return Values{2 + std::sin(x.x), there(x) ? 3.0 : 0.0, 0}; };
  Shape shape;
  shape.ratios = {2, 4};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  LevelRun run(scene, w);
  run.advance(24, 0.5);
  for (const CellState& s : run.states()) {
    const Vec3 x = run.scene.grid.levels[s.level].centre(s.cell);
    EXPECT_EQ(s.values[1], there(x) ? 3 : 0) << "level " << s.level << " at " << x.x << ' ' << x.y;
    EXPECT_EQ(s.values[2], 0);
  }
}

// The same in motion: it gets no further than its donor cells reach, and never below nothing.
TEST_F(Keeping, NothingAheadOfAMaterialThatMoves) {
  Wishes w = moving_spot({16, 16, 1});
  w.velocity_b = {0.25, 0, 0};
  w.start = [&](Vec3 x) { return Values{1, x.x < 4 && x.x > 2 ? 3.0 : 0.0, 0}; };
  Shape shape;
  shape.ratios = {2};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  LevelRun run(scene, w);
  const Values before = run.totals();
  constexpr int steps = 6;
  run.advance(steps, 0.5);
  bool moved = false;
  for (const CellState& s : run.states()) {
    const Vec3 x = run.scene.grid.levels[s.level].centre(s.cell);
    EXPECT_GE(s.values[1], 0);
    moved = moved || (x.x > 4 && s.values[1] > 0);
    // A fine level takes two cells of half the size a step; a coarse cell at an interface one more.
    if (x.x < 2 || x.x > 4 + steps + 1) {
      EXPECT_EQ(s.values[1], 0) << x.x;
    }
  }
  EXPECT_TRUE(moved);
  expect_kept(before, run.totals());
}

TEST_F(Keeping, MemoryFollowsTheCells) {
  Wishes w;
  w.flagged = [](Vec3, double t) { return t < 1; };
  Shape shape;
  shape.cells = {32, 32, 1};
  shape.ratios = {4};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {16, 16, 1});
  LevelRun run(scene, w);
  const auto bytes = [&] {
    return run.hierarchy.level(0).memory_bytes() + run.hierarchy.level(1).memory_bytes();
  };
  const std::size_t coarse_before = run.hierarchy.level(0).memory_bytes();
  run.advance(1, 0.5);
  const std::size_t most = bytes();
  EXPECT_EQ(run.hierarchy.level(1).level().cell_count(), 128 * 128);
  EXPECT_GE(most, 3 * 128 * 128 * quantities * sizeof(double));  // old, new, start of the step
  for (int n = 0; n < 20 && run.hierarchy.level_count() > 1; ++n) run.advance(1, 0.5);
  ASSERT_EQ(run.hierarchy.level_count(), 1);
  EXPECT_LE(bytes(), 2 * coarse_before);
  EXPECT_LE(run.hierarchy.level(1).memory_bytes(), most / 20);
}

}  // namespace
}  // namespace sluice::hierarchy_conservation_test
