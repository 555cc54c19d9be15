// Steps, outputs and checkpoints of a run by the deck's rules; costs from recorded ones.
#include "app/plan/planned_cost.hpp"

#include <gtest/gtest.h>

namespace sluice::planned_cost_test {
namespace {

Scene scene_until(double end) {
  Scene scene;
  scene.time.max_time = end;
  scene.time.end_at_max_time_exactly = true;
  return scene;
}

TEST(PlannedSteps, FollowTheRulesOfTheDeck) {
  Scene scene = scene_until(1);
  scene.output.timestep_interval = 4;             // steps 1, 5 and 9
  scene.output.checkpoint.timestep_interval = 3;  // steps 4, 7 and 10
  scene.output.checkpoint.cycle = 2;
  const PlannedSteps steps = planned_steps(scene, 0.1, 0);
  EXPECT_EQ(steps.steps, 10);
  EXPECT_EQ(steps.outputs, 3);
  EXPECT_EQ(steps.checkpoints, 3);
  EXPECT_EQ(steps.kept, 2);
  EXPECT_EQ(planned_steps(scene, 0.1, 6).steps, 6);
  EXPECT_EQ(planned_steps(scene, 0.1, 6).outputs, 2);
}

// 0.001 (1 + 2 + ... + 64) = 0.127 in seven steps, and nine of 0.1 for the rest.
TEST(PlannedSteps, FirstStepsThatGrow) {
  Scene scene = scene_until(1);
  scene.time.delt_init = 1e-3;
  scene.time.max_delt_increase = 1;
  EXPECT_EQ(planned_steps(scene, 0.1, 0).steps, 16);
}

TEST(PlannedSteps, LongRunsGoOnAsTheyAre) {
  Scene scene = scene_until(1);
  scene.output.interval = 0.01;
  const PlannedSteps steps = planned_steps(scene, 1e-6, 0);
  EXPECT_NEAR(steps.steps, 1e6, 2);
  EXPECT_NEAR(steps.outputs, 101, 2);
}

TEST(PlannedCost, IsStepsTimesCellsAndParticles) {
  CostedRun run;
  run.component = "ice";
  run.dimensions = 2;
  run.cells = run.cell_updates = 1e6;
  run.output_bytes = 1e6;
  const PlannedSteps steps{100, 10, 4, 2};
  const PlannedCost one = planned_cost(run, steps);
  ASSERT_TRUE(one.known);
  // 41 ns a cell and step, on the machine of the record.
  EXPECT_NEAR(one.stepping_s / one.machine, 100 * 1e6 * 41e-9, 0.01);
  EXPECT_NEAR(one.outputs_bytes, 1e7, 3e5);
  run.effects = {"momentum exchange"};
  EXPECT_GT(planned_cost(run, steps).stepping_s, 1.4 * one.stepping_s);
  run.effects.clear();
  run.threads = 2;
  EXPECT_NEAR(planned_cost(run, steps).stepping_s, one.stepping_s / 1.95, 0.01 * one.stepping_s);
  CostedRun solids;
  solids.component = "mpm";
  solids.dimensions = 3;
  solids.particles = 1e5;
  const double gimp = planned_cost(solids, steps).stepping_s;
  solids.interpolator = "cpdi";
  EXPECT_GT(planned_cost(solids, steps).stepping_s, 1.5 * gimp);
  // A component without a record: nothing is told.
  solids.component = "wave";
  EXPECT_FALSE(planned_cost(solids, steps).known);
  EXPECT_EQ(cost_text(planned_cost(solids, steps)), "");
}

}  // namespace
}  // namespace sluice::planned_cost_test
