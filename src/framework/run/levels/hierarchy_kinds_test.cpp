// Kinds of blocks on levels that follow the solution: no choice changes a bit.
#include <cmath>

#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_kinds_test {
namespace {

using namespace hierarchy_test;

// Serially and (see CMakeLists.txt) on three ranks.
class KindsOnRanksAndLevels : public OnLevels {};

// Two levels follow a spot of b, which moves along x and leaves the rows beside it free. At one
// time cells of every level are redone with masked slopes, at another the whole step is attempted
// again.
struct Spot {
  Wishes wishes;
  bool refuse = false;

  explicit Spot(bool kinds) {
    wishes.kinds = kinds;
    wishes.velocity_a = {0.5, 0.25, 0};
    wishes.velocity_b = {0.5, 0, 0};
    wishes.source = 0.125;
    wishes.start = [](Vec3 x) {
      const bool in = std::fabs(x.x - 8) < 2 && std::fabs(x.y - 8) < 1.5;
      return Values{2 + 0.125 * (static_cast<int>(x.x * 3) % 7), in ? 1 + 0.25 * x.x : 0, 1 + x.y};
    };
    wishes.flagged = [](Vec3 x, double t) { return around(x, t); };
    wishes.inadmissible = [this](const Sweeping& s) {
      if (refuse && s.level == 2) return true;
      return !s.masked && s.time > 1 && s.time < 1.5 && s.cell.x == 20 && s.cell.y % 3 == 0;
    };
  }
  static bool around(Vec3 x, double t) {
    const double i = x.x - 8 - 0.5 * t, j = x.y - 8;
    return i * i + j * j < 36;
  }
};

struct Outcome {
  States states;
  std::vector<std::int64_t> with, without;  // blocks run by level
};

Outcome outcome(bool kinds, const SolverOptions& options, bool lock_step = false) {
  Shape shape;
  shape.cells = {40, 40, 1};
  shape.ratios = {2, 2};
  shape.boxes = {2, 2, 1};
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  scene.refinement.lock_step = lock_step;
  Spot spot(kinds);
  LevelRun run(scene, spot.wishes, options);
  for (int n = 0; n < 24; ++n) {
    if (n % 8 == 5) {
      spot.refuse = true;
      EXPECT_FALSE(run.attempt(0.25));
      spot.refuse = false;
    }
    run.advance(1, 0.125);
  }
  Outcome o;
  o.states = run.states();
  for (int l = 0; l < run.hierarchy.level_count(); ++l) {
    const LevelSolver& level = run.hierarchy.level(l);
    Reduction all;
    const auto with = all.add_count(level.graphs().blocks_run(kinds ? 1 : 0)),
               without = all.add_count(kinds ? level.graphs().blocks_run(0) : 0);
    world().reduce(all);
    o.with.push_back(all.count(with));
    o.without.push_back(all.count(without));
  }
  return o;
}

TEST_F(KindsOnRanksAndLevels, NoChoiceChangesABit) {
  const Outcome plain = outcome(false, {});
  ASSERT_EQ(plain.with.size(), 3u);
  SolverOptions small;
  small.block = {4, 4, 1};
  SolverOptions forced = small;
  forced.force_all = true;
  EXPECT_TRUE(same_bits(outcome(true, {}).states, plain.states));
  EXPECT_TRUE(same_bits(outcome(true, forced).states, plain.states));
  const Outcome kinds = outcome(true, small);
  EXPECT_TRUE(same_bits(kinds.states, plain.states));
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_GT(kinds.with[l], 24) << l;
    EXPECT_GT(kinds.without[l], 24) << l;
  }
  EXPECT_TRUE(same_bits(outcome(true, small, true).states, outcome(false, small, true).states));
}

}  // namespace
}  // namespace sluice::hierarchy_kinds_test
