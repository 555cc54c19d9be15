// Passes 5 to 7 of the graph compiler: windows, leads, rings of planes, halo.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/task/graph.hpp"

namespace sluice::graph_plan_test {
namespace {

const RowKernel nothing = [](const Row&) {};

Axes axes_of(std::vector<int> directions) {
  Axes axes;
  axes.count = static_cast<int>(directions.size());
  for (std::size_t a = 0; a < directions.size(); ++a) axes.direction[a] = directions[a];
  return axes;
}

Label state_label() {
  return declare_label({"test_mass", ValueType::real, Centring::cell, "kg", "for tests"});
}

// state -> slope (one cell around) -> face value along y (cells j-1 and j) -> update (faces j,
// j+1).
struct Chain {
  TaskList list;
  VariableId old = list.old_state(state_label(), 0, 1), now = list.new_state(state_label(), 0, 1);
  VariableId slope = list.temporary("slope"), face = list.temporary("face", 1, 1);
  Chain() {
    TaskBuilder slopes = list.task("slopes", 0);
    slopes.read(old, Stencil::box(1));
    slopes.write(slope);
    slopes.kernel(nothing);
    TaskBuilder faces = list.task("faces", 0);
    faces.read(slope, Stencil::along(1, 1, 0));
    faces.write(face);
    faces.kernel(nothing);
    TaskBuilder update = list.task("update", 0);
    update.read(old);
    update.read(face, Stencil::along(1, 0, 1));
    update.write(now);
    update.kernel(nothing);
  }
  SweepPlan plan(const Axes& axes) const { return plan_sweep(list, {0, 1, 2}, axes); }
};

TEST(GraphPlan, WindowsGrowByWhatConsumersRead) {
  const SweepPlan plan = Chain().plan(axes_of({0, 1, 2}));
  EXPECT_EQ(plan.tasks[2].window.low, (IntVec3{0, 0, 0}));
  EXPECT_EQ(plan.tasks[2].window.high, (IntVec3{0, 0, 0}));
  EXPECT_EQ(plan.tasks[1].window.low, (IntVec3{0, 0, 0}));
  EXPECT_EQ(plan.tasks[1].window.high, (IntVec3{0, 1, 0}));
  EXPECT_EQ(plan.tasks[0].window.low, (IntVec3{0, 1, 0}));
  EXPECT_EQ(plan.tasks[0].window.high, (IntVec3{0, 1, 0}));
  EXPECT_EQ(plan.halo, (IntVec3{1, 2, 1}));
  ASSERT_EQ(plan.states_read.size(), 1u);
  EXPECT_EQ(plan.states_read[0], Chain().old);
}

TEST(GraphPlan, InactiveDirectionsHaveNoWindowAndNoHalo) {
  const SweepPlan plan = Chain().plan(axes_of({0, 2}));
  for (const PlannedTask& t : plan.tasks) {
    EXPECT_EQ(t.window.low, IntVec3{});
    EXPECT_EQ(t.window.high, IntVec3{});
  }
  EXPECT_EQ(plan.halo, (IntVec3{1, 0, 1}));
}

// Swept along y: the faces of plane j+1 are needed at plane j, slopes as far ahead as faces.
TEST(GraphPlan, ProducersLeadAlongTheSweptAxis) {
  const SweepPlan plan = Chain().plan(axes_of({0, 1}));
  EXPECT_EQ(plan.tasks[0].lead, 1);
  EXPECT_EQ(plan.tasks[1].lead, 1);
  EXPECT_EQ(plan.tasks[2].lead, 0);
  ASSERT_EQ(plan.buffers.size(), 2u);
  for (const PlannedBuffer& b : plan.buffers) EXPECT_EQ(b.planes, 2);  // slopes j, j+1; faces alike
  const SweepPlan along_z = Chain().plan(axes_of({0, 1, 2}));
  for (const PlannedTask& t : along_z.tasks) EXPECT_EQ(t.lead, 0);
  for (const PlannedBuffer& b : along_z.buffers) EXPECT_EQ(b.planes, 1);
}

TEST(GraphPlan, RingsArePowersOfTwoThatHoldWhatIsStillRead) {
  TaskList list;
  const VariableId now = list.new_state(state_label(), 0, 1);
  const VariableId a = list.temporary("a"), b = list.temporary("b");
  TaskBuilder first = list.task("first", 0);
  first.write(a);
  first.kernel(nothing);
  TaskBuilder second = list.task("second", 0);
  second.read(a, Stencil::along(2, 1, 2));
  second.write(b);
  second.kernel(nothing);
  TaskBuilder third = list.task("third", 0);
  third.read(b, Stencil::along(2, 0, 1));
  third.read(a, Stencil::along(2, 3, 0));
  third.write(now);
  third.kernel(nothing);
  const SweepPlan plan = plan_sweep(list, {0, 1, 2}, axes_of({0, 1, 2}));
  EXPECT_EQ(plan.tasks[0].lead, 3);  // second leads by one and reads two planes ahead
  EXPECT_EQ(plan.tasks[1].lead, 1);
  ASSERT_EQ(plan.buffers.size(), 2u);
  EXPECT_EQ(plan.buffers[0].variable, a);
  EXPECT_EQ(plan.buffers[0].planes, 8);  // planes k-3 .. k+3: seven
  EXPECT_EQ(plan.buffers[1].planes, 2);
  EXPECT_EQ(plan.buffers[0].window.low, (IntVec3{0, 0, 3}));
  EXPECT_EQ(plan.buffers[0].window.high, (IntVec3{0, 0, 3}));
}

TEST(GraphPlan, OneDimensionKeepsWholeRows) {
  const SweepPlan plan = Chain().plan(axes_of({1}));
  for (const PlannedBuffer& b : plan.buffers) EXPECT_EQ(b.planes, 1);
  EXPECT_EQ(plan.tasks[0].lead, 0);
  EXPECT_EQ(plan.tasks[0].window.low, (IntVec3{0, 1, 0}));
}

TEST(GraphPlan, FaceOutputsStoreTheClosingFace) {
  TaskList list;
  const Label faces =
      declare_label({"test_face_output", ValueType::real, Centring::y_face, "1", "for tests"});
  TaskBuilder task = list.task("store", 0);
  task.write(list.output(faces, 0));
  task.kernel(nothing);
  EXPECT_EQ(plan_sweep(list, {0}, axes_of({0, 1})).tasks[0].window.high, (IntVec3{0, 1, 0}));
  EXPECT_EQ(plan_sweep(list, {0}, axes_of({0, 2})).tasks[0].window.high, IntVec3{});
}

TEST(GraphPlan, PrunedTasksLeaveNoTrace) {
  Chain chain;
  TaskBuilder extra = chain.list.task("unwanted", 0);
  extra.read(chain.old, Stencil::box(5));
  const VariableId unwanted = chain.list.temporary("unwanted result");
  extra.write(unwanted);
  extra.kernel(nothing);
  EffectList effects;
  effects.add({"flow", true, "", {}});
  const SweepPlan plan = compile(chain.list, effects, {chain.now}, axes_of({0, 1, 2}));
  EXPECT_EQ(plan.tasks.size(), 3u);
  EXPECT_EQ(plan.halo, (IntVec3{1, 2, 1}));
  EXPECT_FALSE(plan.used[unwanted.index]);
}

TEST(GraphPlan, RefusesStencilsThatReachTooFar) {
  Chain chain;
  TaskBuilder extra = chain.list.task("smooth", 0);
  extra.read(chain.old, Stencil::along(1, max_reach, 0));
  extra.always().kernel(nothing);
  EffectList effects;
  effects.add({"flow", true, "", {}});
  const auto plan = [&] { compile(chain.list, effects, {chain.now}, axes_of({0, 1, 2})); };
  EXPECT_NO_THROW(plan());
  extra.read(chain.old, Stencil::along(0, 0, max_reach + 1));
  EXPECT_THAT(plan, testing::ThrowsMessage<std::logic_error>(testing::HasSubstr(
                        "task 'smooth' reads 'test_mass (old)' 4 cells away; at most 3")));
}

}  // namespace
}  // namespace sluice::graph_plan_test
