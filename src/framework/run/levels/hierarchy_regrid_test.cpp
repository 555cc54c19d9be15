// What a regrid keeps of levels that it leaves where they are, against doing all of it anew.
#include <cmath>
#include <string>

#include "framework/refine/region_exchange.hpp"
#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_regrid_test {
namespace {

using namespace hierarchy_test;

class Regrids : public OnLevels {};

// A spot on its way through a wavy field, and one that passes it. The second holds centres of cells
// of level 0 alone, and asks for no level 2.
Wishes moving_spots() {
  Wishes w;
  w.velocity_a = {0.25, 0.125, 0};
  w.velocity_b = {0.125, 0.25, 0};
  w.start = [](Vec3 x) {
    return Values{2 + std::sin(x.x), 2 + std::cos(x.y), 2 + std::sin(x.x + 2 * x.y)};
  };
  w.flagged = [](Vec3 x, double t) {
    return std::hypot(x.x - 5 - 0.25 * t, x.y - 8) < 1.5 ||
           (std::hypot(x.x - 13 + 2 * t, x.y - 5 - 0.5 * t) < 1.5 && std::fmod(x.x, 1) == 0.5);
  };
  return w;
}

// New cells and ghost cells are interpolated differently: it shows where one became the other.
Scene adaptive_scene(bool periodic) {
  Shape shape;
  shape.ratios = {2, 4};
  shape.periodic = periodic;
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  scene.refinement.interpolation_order = 0;
  scene.refinement.interface_order = 1;
  return scene;
}

// All numbers of the states of all levels, ghosts too.
std::string numbers_of(const Hierarchy& hierarchy) {
  std::string all;
  for (int l = 0; l < hierarchy.level_count(); ++l) {
    const Warehouse& state = hierarchy.level(l).state();
    for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
      for (const int slot : HierarchyMock::slots_of(state)) {
        const RealView v = state.view(slot, 0, n);
        for_each_cell(v.box, [&](IntVec3 c) {
          const double value = v(c);
          all.append(reinterpret_cast<const char*>(&value), sizeof value);
        });
      }
  }
  return all;
}

std::int64_t cells_under(const Hierarchy& hierarchy, int l) {
  std::int64_t cells = 0;
  if (l + 1 >= hierarchy.level_count()) return cells;
  const Level& finer = hierarchy.level(l + 1).level();
  for (const GridBox& b : finer.boxes) cells += coarsen(b.cells, finer.ratio).volume();
  return cells;
}

// After every regrid: boxes of one level changed, or of the other, or of both.
TEST_F(Regrids, WhatIsKeptIsWhatWouldBeFoundAnew) {
  const Wishes wishes = moving_spots();
  for (const bool periodic : {true, false}) {
    LevelRun run(adaptive_scene(periodic), wishes);
    Hierarchy& h = run.hierarchy;
    int only_finest = 0, only_middle = 0;
    for (int n = 0; n < 40; ++n) {
      ASSERT_TRUE(run.attempt(0.125));
      const auto boxes = [&](int l) { return cells_of(h.level(l).level().boxes); };
      const auto middle = boxes(1), finest = boxes(2);
      h.fill_ghosts(run.time);
      h.regrid(run.step);
      only_finest += boxes(1) == middle && boxes(2) != finest ? 1 : 0;
      only_middle += boxes(1) != middle && boxes(2) == finest ? 1 : 0;
      h.fill_ghosts(run.time);  // what is not known to be filled
      const std::string kept = numbers_of(h);
      for (int l = 0; l < h.level_count(); ++l) {
        EXPECT_EQ(h.level(l).graphs().coverage().uncovered_cells(),
                  h.level(l).level().cell_count() - cells_under(h, l));
        h.level(l).mark_modified();
      }
      h.fill_ghosts(run.time);
      ASSERT_TRUE(kept == numbers_of(h)) << "after step " << run.step;
    }
    EXPECT_GT(only_finest, 3);
    EXPECT_GT(only_middle, 0);
  }
}

}  // namespace
}  // namespace sluice::hierarchy_regrid_test
