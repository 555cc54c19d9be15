// Scenes of several levels, and runs of the mock over them, for the tests of the hierarchy.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <tuple>

#include "framework/run/levels/hierarchy.hpp"
#include "framework/run/test_support/hierarchy_mock.hpp"

namespace sluice::hierarchy_test {

// One at a time in a process: shared by all runs that a test makes.
class OnLevels : public testing::Test {
 protected:
  OnLevels() { control() = std::make_unique<RunControl>(); }
  ~OnLevels() override { control().reset(); }

 public:
  static std::unique_ptr<RunControl>& control() {
    static std::unique_ptr<RunControl> c;
    return c;
  }
};

struct Shape {
  IntVec3 cells{16, 16, 1};    // of level 0, of size 1; one cell: no dimension of the run
  std::vector<int> ratios{2};  // of the finer levels
  bool periodic = true;
  IntVec3 boxes{1, 1, 1};  // of level 0
};

// Finer levels without boxes.
inline Scene scene_of(const Shape& shape) {
  Scene scene;
  Level level;
  level.domain = {{0, 0, 0}, shape.cells};
  for (std::size_t d = 0; d < 3; ++d) {
    level.active[d] = shape.cells[static_cast<int>(d)] > 1;
    level.periodic[d] = level.active[d] && shape.periodic;
  }
  for (const IndexBox& b : split(level.domain, shape.boxes))
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  assign_owners(level.boxes, world().size());
  scene.grid.levels.push_back(level);
  level.boxes.clear();
  for (const int ratio : shape.ratios) {
    ++level.index;
    for (int d = 0; d < 3; ++d) {
      level.ratio[d] = level.active[d] ? ratio : 1;
      level.spacing[d] /= level.ratio[d];
    }
    level.domain = refine(level.domain, level.ratio);
    scene.grid.levels.push_back(level);
  }
  scene.refinement.max_levels = static_cast<int>(scene.grid.levels.size());
  return scene;
}

// A static level over cells of the next coarser one, cut into pieces.
inline void add_boxes(Scene& scene, int l, const IndexBox& coarse_cells,
                      IntVec3 pieces = {1, 1, 1}) {
  Level& level = scene.grid.levels[l];
  for (const IndexBox& b : split(coarse_cells, pieces))
    level.boxes.push_back({refine(b, level.ratio), 0, static_cast<int>(level.boxes.size())});
  assign_owners(level.boxes, world().size());
}

// Levels that follow flags; tiles of this size on every finer level.
inline void make_adaptive(Scene& scene, IntVec3 tile) {
  RefinementSettings& r = scene.refinement;
  IntVec3 active{};
  for (int d = 0; d < 3; ++d) active[d] = scene.grid.levels.front().active[d] ? 1 : 0;
  r.adaptive = true;
  r.max_interval = 1;
  r.tile.assign(scene.grid.levels.size(), max(active * tile, IntVec3::all(1)));
  r.stability_dilation = r.min_boundary_cells = active;
  r.deletion_dilation = {};
  r.regrid_dilation = {};
}

// The state of one cell, comparable to the bit and over ranks.
struct CellState {
  int level = 0;
  IntVec3 cell{};
  Values values{};
  friend bool operator==(const CellState& x, const CellState& y) {
    return x.level == y.level && x.cell == y.cell &&
           std::memcmp(x.values.data(), y.values.data(), sizeof(Values)) == 0;
  }
};
using States = std::vector<CellState>;

// Names the first cell that differs.
inline testing::AssertionResult same_bits(const States& x, const States& y) {
  if (x.size() != y.size())
    return testing::AssertionFailure() << x.size() << " cells and " << y.size();
  for (std::size_t n = 0; n < x.size(); ++n)
    if (!(x[n] == y[n]))
      return testing::AssertionFailure()
             << "level " << x[n].level << " cell " << x[n].cell.x << ' ' << x[n].cell.y << ' '
             << x[n].cell.z << " differs by " << x[n].values[0] - y[n].values[0] << ' '
             << x[n].values[1] - y[n].values[1] << ' ' << x[n].values[2] - y[n].values[2];
  return testing::AssertionSuccess();
}

// Of all levels, boxes and ranks, sorted by level and cell.
inline States states_of(const Hierarchy& hierarchy) {
  std::string mine;
  for (int l = 0; l < hierarchy.level_count(); ++l) {
    const Warehouse& state = hierarchy.level(l).state();
    const auto slots = HierarchyMock::slots_of(state);
    for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
      for_each_cell(state.local_boxes()[n].cells, [&](IntVec3 c) {
        CellState s{l, c, {}};
        for (std::size_t q = 0; q < quantities; ++q) s.values[q] = state.view(slots[q], 0, n)(c);
        mine.append(reinterpret_cast<const char*>(&s), sizeof s);
      });
  }
  States all;
  for (const std::string& text : world().gather_to_all(mine))
    for (std::size_t at = 0; at < text.size(); at += sizeof(CellState)) {
      all.emplace_back();
      std::memcpy(&all.back(), text.data() + at, sizeof(CellState));
    }
  const auto key = [](const CellState& s) {
    return std::tuple(s.level, s.cell.z, s.cell.y, s.cell.x);
  };
  std::sort(all.begin(), all.end(),
            [&](const CellState& x, const CellState& y) { return key(x) < key(y); });
  return all;
}

// A scene, a mock and its levels, stepped by hand.
struct LevelRun {
  Scene scene;
  const Wishes& wishes;
  HierarchyMock mock;
  Hierarchy hierarchy;
  EventLedger ledger;
  CycleResult result;
  double time = 0;
  int step = 0;

  LevelRun(const Scene& s, const Wishes& w, const SolverOptions& o = {})
      : scene(s), wishes(w), mock(scene, wishes), hierarchy(scene, mock, world(), o) {
    hierarchy.initialise();
    forget_calls();
  }
  LevelRun(const LevelRun&) = delete;
  LevelRun& operator=(const LevelRun&) = delete;

  void forget_calls() {
    mock.sweeps.clear();
    mock.boundary_fills.clear();
  }
  // One attempt; its outcome is accepted or rejected.
  bool attempt(double dt, const std::vector<Label>& wanted = {}) {
    result = hierarchy.attempt(step + 1, time, dt, wanted, *OnLevels::control(), ledger);
    if (result.good) {
      hierarchy.accept();
      ledger.accept_step();
      time += dt;
      ++step;
    } else {
      hierarchy.reject();
      ledger.reject_step();
    }
    return result.good;
  }
  // Steps with a regrid after each.
  void advance(int steps, double dt) {
    for (int n = 0; n < steps; ++n) {
      ASSERT_TRUE(attempt(dt));
      hierarchy.regrid(step);
    }
  }
  States states() const { return states_of(hierarchy); }
  // Of a, b and s over all ranks.
  Values totals() const {
    Totals t;
    hierarchy.add_totals(t);
    Values v{};
    for (std::size_t q = 0; q < quantities; ++q) {
      Reduction all;
      const auto sum = all.add_sum(t.mass[q].sum);
      world().reduce(all);
      v[q] = all.sum(sum).value();
    }
    return v;
  }
};

}  // namespace sluice::hierarchy_test
