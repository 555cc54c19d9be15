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

// Blocks run by level, counted on over the solvers that a level has in turn: a regrid, or a balance
// that measured times ask for, makes it a new one.
class BlockCounts {
 public:
  explicit BlockCounts(std::size_t levels) : last_(levels), sums_(levels) {}
  void see(int level, std::int64_t since_construction) {
    const auto l = static_cast<std::size_t>(level);
    sums_[l] += since_construction - (since_construction < last_[l] ? 0 : last_[l]);
    last_[l] = since_construction;
  }
  std::vector<std::int64_t> of_all_ranks() const {
    std::vector<std::int64_t> counts;
    for (const std::int64_t sum : sums_) {
      Reduction all;
      const auto count = all.add_count(sum);
      world().reduce(all);
      counts.push_back(all.count(count));
    }
    return counts;
  }

 private:
  std::vector<std::int64_t> last_, sums_;
};

struct Outcome {
  States states;
  std::vector<std::int64_t> with, without;  // blocks run by level
  int levels = 0;                           // at the end
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
  BlockCounts with(3), without(3);
  for (int n = 0; n < 24; ++n) {
    if (n % 8 == 5) {
      spot.refuse = true;
      EXPECT_FALSE(run.attempt(0.25));
      spot.refuse = false;
    }
    run.advance(1, 0.125);
    for (int l = 0; l < run.hierarchy.level_count(); ++l) {
      const LevelSolver& level = run.hierarchy.level(l);
      with.see(l, level.graphs().blocks_run(kinds ? 1 : 0));
      if (kinds) without.see(l, level.graphs().blocks_run(0));
    }
  }
  return {run.states(), with.of_all_ranks(), without.of_all_ranks(), run.hierarchy.level_count()};
}

TEST_F(KindsOnRanksAndLevels, NoChoiceChangesABit) {
  const Outcome plain = outcome(false, {});
  ASSERT_EQ(plain.levels, 3);
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
