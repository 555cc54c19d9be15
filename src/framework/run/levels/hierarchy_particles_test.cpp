// Where particles on levels find their place: nodes before the ghost cells, and the step's journal.
#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_particles_test {
namespace {

using namespace hierarchy_test;

class ParticlesOnLevels : public OnLevels {
 protected:
  // One particle, seen as the second material in the cell of each level that holds it. It moves
  // along x with speed 1 when the coarse step is accepted.
  Schedule nodes(LevelSolver& level) {
    return {{Sweep{"projection", level.level().index,
                   [this, &level](const StepScope& scope, StepJournal& journal) {
                     project(level);
                     if (scope.level == 0)
                       journal.at_acceptance([this, dt = scope.dt] { place_.x += dt; });
                     return Verdict::good;
                   }}}};
  }
  void project(LevelSolver& level) const {
    Warehouse& state = level.state();
    const int slot = state.find(mock_labels().b, 1);
    for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
      for_each_cell(state.local_boxes()[n].cells, [&](IntVec3 c) {
        state.view(slot, 0, n)(c) = holds(level.level(), c) ? 1 / level.level().cell_volume() : 0;
      });
    level.mark_modified();
  }
  bool holds(const Level& level, IntVec3 c) const {
    const Vec3 x = level.centre(c);
    for (int d = 0; d < 2; ++d)
      if (place_[d] < x[d] - level.spacing[d] / 2 || place_[d] >= x[d] + level.spacing[d] / 2)
        return false;
    return true;
  }
  Vec3 place_{6.25, 8.25, 0.5};
};

TEST_F(ParticlesOnLevels, AreProjectedOnEveryLevelAndMoveOnceWhenTheStepIsAccepted) {
  Shape shape;
  shape.ratios = {2};
  Scene scene = scene_of(shape);
  add_boxes(scene, 1, {{4, 4, 0}, {12, 12, 1}});
  Wishes w;
  bool refuse = true;
  w.start = [](Vec3) { return Values{1, 0, 0}; };
  w.before = [this](LevelSolver& level) { return nodes(level); };
  w.inadmissible = [&](const Sweeping& s) { return refuse && s.level == 1 && s.time > 0; };
  LevelRun run(scene, w);
  EXPECT_FALSE(run.attempt(1));  // in the second substep
  EXPECT_EQ(place_.x, 6.25);
  refuse = false;
  for (int n = 1; n <= 4; ++n) {
    const Vec3 seen = place_;
    ASSERT_TRUE(run.attempt(0.5));
    EXPECT_EQ(place_.x, 6.25 + 0.5 * n);
    EXPECT_EQ(run.totals()[1], 1);  // of one particle, however often it was projected
    for (const CellState& s : run.states()) {
      const Level& level = run.scene.grid.levels[s.level];
      const Vec3 x = level.centre(s.cell);
      if (std::fabs(x.x - seen.x) > level.spacing.x || std::fabs(x.y - seen.y) > level.spacing.y) {
        EXPECT_EQ(s.values[1], 0);
      }
    }
  }
}

}  // namespace
}  // namespace sluice::hierarchy_particles_test
