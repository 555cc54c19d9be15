// Random graphs swept over blocks give the bits of a cell-by-cell reference, whatever the blocks.
#include "framework/task/block_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/task/sweep_executor.hpp"
#include "framework/task/sweep_test_support.hpp"

namespace sluice::block_sweep_test {
namespace {

using namespace sweep_test;

// Old state with ghosts as wide as the graph reads, filled everywhere.
Warehouse filled_state(const Level& level, int ghosts) {
  Warehouse state(level, 0);
  for (int s = 0; s < 2; ++s) {
    const int components = s == 0 ? 2 : 1;
    const int slot = state.add({test_label(s), 0, components, ghosts});
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for (int c = 0; c < components; ++c) {
        const RealView v = state.view(slot, c, b);
        for_each_cell(v.box, [&](IntVec3 cell) { v(cell) = RandomGraph::initial(s, c, cell); });
      }
  }
  return state;
}

Warehouse empty_state(const Level& level) {
  Warehouse state(level, 0);
  state.add({test_label(0), 0, 2, 0});
  state.add({test_label(1), 0, 1, 0});
  return state;
}

void expect_reference(RandomGraph& graph, const Warehouse& now, const std::string& what) {
  for (int s = 0; s < 2; ++s)
    for (int b = 0; b < static_cast<int>(now.local_boxes().size()); ++b)
      for (int c = 0; c < (s == 0 ? 2 : 1); ++c) {
        const RealView v = now.view(s, c, b);
        for_each_cell(now.local_boxes()[b].cells, [&](IntVec3 cell) {
          ASSERT_EQ(v(cell), graph.reference(graph.news[s], c, cell))
              << what << ", state " << s << '.' << c << " at " << cell.x << ' ' << cell.y << ' '
              << cell.z;
        });
      }
}

struct Shape {
  IntVec3 cells, pieces;
  std::vector<IntVec3> blocks;
};

class BlockSweepOnShapes : public testing::TestWithParam<Shape> {};

TEST_P(BlockSweepOnShapes, GivesTheBitsOfTheReference) {
  const Shape& shape = GetParam();
  const Level level = level_of(shape.cells, shape.pieces, {-3, 2, 5});
  const Axes axes = axes_of(level);
  EffectList effects;
  effects.add({"test", true, "", {}});
  for (unsigned seed = 1; seed <= 12; ++seed) {
    RandomGraph graph(seed, axes);
    const SweepPlan plan = compile(graph.list, effects, graph.news, axes);
    const int ghosts = std::max({plan.halo.x, plan.halo.y, plan.halo.z});
    const Warehouse old = filled_state(level, ghosts);
    for (const IntVec3 block : shape.blocks) {
      Warehouse now = empty_state(level);
      SweepOptions options;
      options.block = block;
      SweepExecutor executor(graph.list, plan, level, options);
      executor.bind(old, now, nullptr);
      executor.run({});
      expect_reference(graph, now, "seed " + std::to_string(seed));
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, BlockSweepOnShapes,
    testing::Values(Shape{{23, 1, 1}, {1, 1, 1}, {{23, 1, 1}, {5, 1, 1}, {1, 1, 1}}},
                    Shape{{1, 17, 1}, {1, 3, 1}, {{1, 17, 1}, {1, 4, 1}}},
                    Shape{{1, 1, 9}, {1, 1, 2}, {{1, 1, 3}}},
                    Shape{{9, 7, 1}, {2, 1, 1}, {{9, 7, 1}, {3, 2, 1}, {1, 1, 1}}},
                    Shape{{7, 1, 8}, {1, 1, 3}, {{7, 1, 8}, {2, 1, 5}}},
                    Shape{{1, 6, 7}, {1, 2, 1}, {{1, 6, 7}, {1, 1, 2}}},
                    Shape{{6, 5, 7}, {1, 2, 1}, {{6, 5, 7}, {4, 3, 2}, {1, 2, 1}}}),
    [](const auto& test) {
      const IntVec3 n = test.param.cells;
      return std::to_string(n.x) + "x" + std::to_string(n.y) + "x" + std::to_string(n.z);
    });

// Only what goes to scratch memory may be computed beyond the row.
TEST(BlockSweep, StoringTasksComputeTheirRowsOnly) {
  const Level level = level_of({21, 6, 1});
  EffectList effects;
  effects.add({"test", true, "", {}});
  TaskList list;
  const VariableId old = list.old_state(test_label(0), 0, 2), passing = list.temporary("passing");
  const VariableId now = list.new_state(test_label(0), 0, 2);
  std::vector<int> beyond_scratch, beyond_state;
  TaskBuilder first = list.task("first", 0);
  first.read(old);
  first.write(passing);
  first.kernel(
      [&](const Row& row) { beyond_scratch.push_back(row.whole_vectors() - row.count()); });
  TaskBuilder second = list.task("second", 0);
  second.read(passing);
  second.write(now);
  second.kernel([&](const Row& row) {
    beyond_state.push_back(row.whole_vectors() - row.count());
    EXPECT_EQ(row.part(2, 3).whole_vectors(), 3);
  });
  const Axes axes = axes_of(level);
  const Warehouse before = filled_state(level, 0);
  Warehouse after = empty_state(level);
  SweepExecutor executor(list, compile(list, effects, {now}, axes), level, SweepOptions{});
  executor.bind(before, after, nullptr);
  executor.run({});
  EXPECT_EQ(beyond_scratch, std::vector<int>(6, 3));
  EXPECT_EQ(beyond_state, std::vector<int>(6, 0));
}

// Boxes of different widths on top of each other, as tiles leave them: swept as stacks, also with
// gaps, and where one box lies on two.
TEST(BlockSweep, StacksOfUnequalBoxesGiveTheBitsOfTheReference) {
  EffectList effects;
  effects.add({"test", true, "", {}});
  const std::vector<std::vector<IndexBox>> flat = {{{{2, 0, 0}, {20, 4, 1}},
                                                    {{4, 4, 0}, {14, 9, 1}},
                                                    {{12, 9, 0}, {22, 10, 1}},
                                                    {{0, 10, 0}, {13, 12, 1}},
                                                    {{15, 10, 0}, {24, 17, 1}},
                                                    {{16, 4, 0}, {20, 8, 1}}},
                                                   {{{0, 0, 0}, {9, 2, 1}},
                                                    {{10, 0, 0}, {24, 2, 1}},
                                                    {{3, 2, 0}, {21, 3, 1}},
                                                    {{0, 3, 0}, {24, 17, 1}}}};
  const std::vector<std::vector<IndexBox>> deep = {{{{0, 0, 0}, {9, 6, 3}},
                                                    {{0, 0, 3}, {9, 6, 5}},
                                                    {{1, 0, 5}, {9, 6, 6}},
                                                    {{0, 3, 6}, {6, 6, 9}}}};
  for (const bool three : {false, true})
    for (const auto& boxes : three ? deep : flat) {
      Level level = level_of(three ? IntVec3{10, 7, 9} : IntVec3{24, 17, 1});
      level.boxes.clear();
      for (const IndexBox& b : boxes)
        level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
      const Axes axes = axes_of(level);
      for (unsigned seed = 1; seed <= 12; ++seed) {
        RandomGraph graph(seed, axes);
        const SweepPlan plan = compile(graph.list, effects, graph.news, axes);
        const Warehouse old =
            filled_state(level, std::max({plan.halo.x, plan.halo.y, plan.halo.z}));
        for (const int threads : {1, 2}) {
          Warehouse now = empty_state(level);
          SweepOptions options;
          options.threads = threads;
          options.block = {20, 3, 3};
          SweepExecutor executor(graph.list, plan, level, options);
          executor.bind(old, now, nullptr);
          executor.run({});
          expect_reference(graph, now, "seed " + std::to_string(seed));
          if (HasFatalFailure()) return;
        }
      }
    }
}

// Two blocks of a column compute the plane between them once.
TEST(BlockSweep, AStackComputesSharedPlanesOnce) {
  const Level level = level_of({8, 12, 1});
  TaskList list;
  const VariableId old = list.old_state(test_label(1), 0, 1),
                   now = list.new_state(test_label(1), 0, 1);
  const VariableId slope = list.temporary("slope");
  int rows = 0;
  TaskBuilder slopes = list.task("slopes", 0);
  slopes.read(old);
  slopes.write(slope);
  slopes.kernel([&rows](const Row&) { ++rows; });
  TaskBuilder update = list.task("update", 0);
  update.read(slope, Stencil::along(1, 1, 1));
  update.write(now);
  update.kernel([](const Row&) {});
  Warehouse before(level, 0), after(level, 0);
  before.add({test_label(1), 0, 1, 1});
  after.add({test_label(1), 0, 1, 0});
  SweepOptions options;
  options.block = {8, 3, 1};
  SweepExecutor executor(list, plan_sweep(list, {0, 1}, axes_of(level)), level, options);
  executor.bind(before, after, nullptr);
  executor.run({});
  EXPECT_EQ(rows, 14);  // 4 blocks of 5 rows each would be 20
  EXPECT_EQ(executor.blocks_run(), 4);
}

// Where a narrow box lies below a wide one, the wide one's rows hold what the narrow one wants.
TEST(BlockSweep, AStackOfUnequalBoxesComputesTheWidestRows) {
  Level level = level_of({24, 12, 1});
  level.boxes = {{{{8, 0, 0}, {16, 6, 1}}, 0, 0}, {{{4, 6, 0}, {20, 12, 1}}, 0, 1}};
  TaskList list;
  const VariableId old = list.old_state(test_label(1), 0, 1),
                   now = list.new_state(test_label(1), 0, 1);
  const VariableId slope = list.temporary("slope");
  std::vector<int> counts;
  TaskBuilder slopes = list.task("slopes", 0);
  slopes.read(old);
  slopes.write(slope);
  slopes.kernel([&counts](const Row& row) { counts.push_back(row.count()); });
  TaskBuilder update = list.task("update", 0);
  update.read(slope, Stencil::along(1, 1, 1));
  update.write(now);
  update.kernel([](const Row&) {});
  Warehouse before(level, 0), after(level, 0);
  before.add({test_label(1), 0, 1, 1});
  after.add({test_label(1), 0, 1, 0});
  SweepExecutor executor(list, plan_sweep(list, {0, 1}, axes_of(level)), level, {});
  executor.bind(before, after, nullptr);
  executor.run({});
  // Rows -1 to 4 of the low box, 5 to 12 of the high one.
  std::vector<int> expected(6, 8);
  expected.insert(expected.end(), 8, 16);
  EXPECT_EQ(counts, expected);
}

// What a task asks of a box holds for its cells and ghosts alone: no row may go beyond, though the
// task reads and writes temporaries only.
TEST(BlockSweep, RowsOfATaskThatAsksForTheBoxStayInIt) {
  Level level = level_of({24, 12, 1});
  level.boxes = {{{{8, 0, 0}, {16, 6, 1}}, 0, 0}, {{{4, 6, 0}, {20, 12, 1}}, 0, 1}};
  const auto cells_of_rows = [&](bool needs_box) {
    TaskList list;
    const VariableId old = list.old_state(test_label(1), 0, 1),
                     now = list.new_state(test_label(1), 0, 1);
    const VariableId value = list.temporary("value"), slope = list.temporary("slope");
    TaskBuilder values = list.task("values", 0);
    values.read(old);
    values.write(value);
    values.kernel([](const Row&) {});
    std::vector<std::pair<IntVec3, int>> beyond, seen;  // cell, box
    TaskBuilder slopes = list.task("slopes", 0);
    slopes.read(value);
    slopes.write(slope);
    if (needs_box) slopes.needs_box();
    slopes.kernel([&](const Row& row) {
      const IndexBox box = level.boxes[row.box()].cells.grown({1, 1, 0});
      for (int i = 0; i < row.count(); ++i) {
        const IntVec3 cell = row.cell() + IntVec3{i, 0, 0};
        (box.contains(cell) ? seen : beyond).emplace_back(cell, row.box());
      }
    });
    TaskBuilder update = list.task("update", 0);
    update.read(slope, Stencil::box(1));
    update.write(now);
    update.kernel([](const Row&) {});
    Warehouse before(level, 0, Arrays::shared), after(level, 0, Arrays::shared);
    before.add({test_label(1), 0, 1, 1});
    after.add({test_label(1), 0, 1, 1});
    SweepExecutor executor(list, plan_sweep(list, {0, 1, 2}, axes_of(level)), level, {});
    executor.bind(before, after, nullptr);
    executor.run({});
    return std::pair(seen.size(), beyond.size());
  };
  // The low box has rows -1 to 4 to itself; 5 and 6 are as wide as the high box wants them.
  EXPECT_EQ(cells_of_rows(true), (std::pair<std::size_t, std::size_t>(6 * 10 + 8 * 18, 0)));
  EXPECT_GT(cells_of_rows(false).second, 0u);
}

// A task that has something to do in a part of its blocks only is run there, and nowhere else: in
// lines, planes and space, over single blocks and stacks.
TEST(BlockSweep, ATaskForPartsOfBlocksIsRunThere) {
  for (const IntVec3 size : {IntVec3{24, 1, 1}, IntVec3{24, 12, 1}, IntVec3{24, 6, 8}}) {
    const Level level = level_of(size);
    const IndexBox part{{5, size.y > 1 ? 2 : 0, size.z > 1 ? 3 : 0},
                        {14, size.y > 1 ? 5 : 1, size.z > 1 ? 7 : 1}};
    TaskList list;
    const VariableId old = list.old_state(test_label(1), 0, 1),
                     now = list.new_state(test_label(1), 0, 1);
    std::vector<int> seen(level.domain.volume(), 0);
    TaskBuilder counts = list.task("counts", 0);
    counts.read(old);
    counts.always().only_in([=](int, const IndexBox& block) { return intersection(part, block); });
    counts.kernel([&](const Row& row) {
      for (int i = 0; i < row.count(); ++i) {
        const IntVec3 c = row.cell() + IntVec3{i, 0, 0};
        ++seen[c.x + size.x * (c.y + size.y * c.z)];
      }
    });
    TaskBuilder update = list.task("update", 0);
    update.read(old);
    update.write(now);
    update.kernel([](const Row&) {});
    const Axes axes = axes_of(level);
    for (const IntVec3 block : {IntVec3{100, 100, 100}, IntVec3{8, 3, 2}}) {
      std::fill(seen.begin(), seen.end(), 0);
      Warehouse before(level, 0), after(level, 0);
      before.add({test_label(1), 0, 1, 0});
      after.add({test_label(1), 0, 1, 0});
      SweepOptions options;
      options.block = block;
      SweepExecutor executor(list, plan_sweep(list, {0, 1}, axes), level, options);
      executor.bind(before, after, nullptr);
      executor.run({});
      std::size_t n = 0;
      for_each_cell(level.domain, [&](IntVec3 c) {
        EXPECT_EQ(seen[n++], part.contains(c) ? 1 : 0) << c.x << ' ' << c.y << ' ' << c.z;
      });
    }
  }
}

// A kernel is told where its row lies, on which level and in which step.
TEST(BlockSweep, RowsKnowTheirPlace) {
  const Level level = level_of({4, 3, 2}, {1, 1, 1}, {10, 20, 30});
  TaskList list;
  const VariableId now = list.new_state(test_label(1), 0, 1);
  std::vector<IntVec3> rows;
  TaskBuilder task = list.task("where", 0);
  const Out out = task.write(now);
  task.kernel([&rows, out](const Row& row) {
    rows.push_back(row.cell());
    EXPECT_EQ(row.count(), 4);
    EXPECT_EQ(row.block_low(), (IntVec3{10, 20, 30}));
    EXPECT_EQ(row.block_high(), (IntVec3{14, 23, 32}));
    EXPECT_EQ(row.step().dt, 0.25);
    for (int i = 0; i < row.count(); ++i) row(out)[i] = 1;
  });
  const Axes axes = axes_of(level);
  Warehouse old(level, 0), next(level, 0);
  next.add({test_label(1), 0, 1, 0});
  SweepExecutor executor(list, plan_sweep(list, {0}, axes), level, {});
  executor.bind(old, next, nullptr);
  StepConstants step;
  step.dt = 0.25;
  executor.run(step);
  EXPECT_EQ(
      rows,
      (std::vector<IntVec3>{
          {10, 20, 30}, {10, 21, 30}, {10, 22, 30}, {10, 20, 31}, {10, 21, 31}, {10, 22, 31}}));
}

TEST(BlockSweep, ScratchIsAFewPlanesOnly) {
  const Level flat = level_of({64, 1000, 1});
  const Axes axes = axes_of(flat);
  TaskList list;
  const VariableId old = list.old_state(test_label(1), 0, 1),
                   now = list.new_state(test_label(1), 0, 1);
  const VariableId slope = list.temporary("slope");
  TaskBuilder slopes = list.task("slopes", 0);
  slopes.read(old, Stencil::box(1));
  slopes.write(slope);
  slopes.kernel([](const Row&) {});
  TaskBuilder update = list.task("update", 0);
  update.read(slope, Stencil::along(1, 1, 1));
  update.write(now);
  update.kernel([](const Row&) {});
  const SweepPlan plan = plan_sweep(list, {0, 1}, axes);
  const StateBinding binding;
  const BlockSweep sweep(list, plan, flat, binding, {64, 1000, 1});
  // Three planes, in a ring of four; a vector beyond each row, and two at the end.
  EXPECT_EQ(sweep.scratch_bytes(), (4u * (64u + 8u) + 2u * 8u) * sizeof(double));
}

TEST(BlockSweep, StorageThatIsMissingIsNamed) {
  const Level level = level_of({4, 1, 1});
  TaskList list;
  TaskBuilder task = list.task("update", 0);
  task.write(list.new_state(test_label(1), 0, 1));
  task.kernel([](const Row&) {});
  Warehouse old(level, 0), next(level, 0);
  SweepExecutor executor(list, plan_sweep(list, {0}, axes_of(level)), level, {});
  EXPECT_THROW(
      {
        try {
          executor.bind(old, next, nullptr);
        } catch (const std::logic_error& e) {
          EXPECT_STREQ(e.what(), "no storage for 'test_state_1 (new)'");
          throw;
        }
      },
      std::logic_error);
}

}  // namespace
}  // namespace sluice::block_sweep_test
