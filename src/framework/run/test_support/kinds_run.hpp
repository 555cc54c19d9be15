// A level of two materials (kinds_mock.hpp) with its solver, for the tests of kinds of blocks.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "framework/run/levels/level_solver.hpp"
#include "framework/run/test_support/kinds_mock.hpp"

namespace sluice::kinds_test {

// The second material left of the first, a few mixed cells between them, a fragment of the second
// further on, uniform to the right.
inline double start(int material, IntVec3 c) {
  const int front = 14 + c.y % 3 + c.z % 2;
  const bool fragment = c.x >= 50 && c.x < 53 && c.y < 4;
  if (material == 1) return c.x < front + 2 ? 2 + 0.25 * ((c.x + c.y) % 3) : fragment ? 0.5 : 0.0;
  if (c.x < front) return 0;
  return c.x > 66 ? 1 : 1 + 0.125 * ((c.x * 3 + c.y + c.z) % 5);
}

inline Level level_of(IntVec3 cells, IntVec3 pieces) {
  Level level;
  level.domain = {{0, 0, 0}, cells};
  for (int d = 0; d < 3; ++d) level.active[d] = cells[d] > 1;
  for (const IndexBox& b : split(level.domain, pieces))
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  assign_owners(level.boxes, world().size());
  return level;
}

struct KindsRun {
  Level level;
  KindsMock mock;
  LevelSolver solver;

  KindsRun(IntVec3 cells, const SolverOptions& o, IntVec3 pieces = {1, 1, 1},
           const KindsMock::Start& from = start, double most = 1e300)
      : level(level_of(cells, pieces)),
        mock(with_most(level, from, most)),
        solver(mock, level, world(), o) {
    mock.state().initialise(solver.state());
    solver.mark_modified();
  }
  static KindsMock with_most(const Level& level, const KindsMock::Start& from, double most) {
    KindsMock m(level, from);
    m.most = most;
    return m;
  }
  const StepAttempt& attempt(double dt, const std::vector<Label>& wanted = {}) {
    solver.fill_ghosts(0);
    return solver.attempt(0, dt, wanted, nullptr);
  }
  void step(double dt, const std::vector<Label>& wanted = {}) {
    attempt(dt, wanted);
    solver.advance();
    solver.accept();
  }
  // Blocks of the current state that are known to be uniform in a slot; all must be.
  int known(int slot) {
    const Warehouse& state = solver.state();
    int count = 0;
    if (state.blocks().size() == 0) return count;
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      state.blocks().any_block(b, level.domain, [&](int block, const IndexBox& cells) {
        const double value = state.uniform(slot, block);
        if (std::isnan(value)) return false;
        ++count;
        for (int c = 0; c < state.info(slot).components; ++c)
          EXPECT_FALSE(any_other(state.view(slot, c, b), cells, value)) << "slot " << slot;
        return false;
      });
    return count;
  }
};

}  // namespace sluice::kinds_test
