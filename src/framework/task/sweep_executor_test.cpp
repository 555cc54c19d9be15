// Placement on blocks and threads, sleeping blocks, sampling: none may change a bit.
#include "framework/task/sweep_executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "framework/task/sweep_test_support.hpp"

namespace sluice::sweep_executor_test {
namespace {

using namespace sweep_test;

TEST(PlaceBlocks, CoverEveryBoxOnceAndStayWithinTheExtents) {
  const Level level = level_of({37, 11, 5}, {3, 2, 1});
  const IntVec3 extents{8, 4, 5};
  std::vector<int> seen(level.domain.volume(), 0);
  for (const Block& b : place_blocks(level.boxes, extents)) {
    EXPECT_EQ(max(b.cells.size(), extents), extents);
    EXPECT_TRUE(level.boxes[b.box].cells.contains(b.cells));
    for_each_cell(b.cells, [&](IntVec3 c) { ++seen[c.x + 37 * (c.y + 11 * c.z)]; });
  }
  EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

TEST(StackBlocks, HoldEveryBlockOnceInOrder) {
  Level level = level_of({40, 40, 1});
  level.boxes = {{{{0, 0, 0}, {40, 8, 1}}, 0, 0},    {{{4, 8, 0}, {36, 16, 1}}, 0, 1},
                 {{{0, 16, 0}, {12, 40, 1}}, 0, 2},  {{{30, 16, 0}, {40, 40, 1}}, 0, 3},
                 {{{14, 20, 0}, {22, 40, 1}}, 0, 4}, {{{24, 16, 0}, {26, 20, 1}}, 0, 5}};
  const std::vector<Block> blocks = place_blocks(level.boxes, {40, 8, 1});
  for (const std::int64_t most : {std::int64_t{1}, std::int64_t{600}, std::int64_t{10000}}) {
    std::set<std::size_t> met;
    for (const auto& stack : stack_blocks(blocks, level, most)) {
      std::int64_t cells = 0;
      for (std::size_t n = 0; n < stack.size(); ++n) {
        EXPECT_TRUE(met.insert(stack[n]).second);
        const IndexBox& here = blocks[stack[n]].cells;
        cells += here.volume();
        if (n == 0) continue;
        const IndexBox& below = blocks[stack[n - 1]].cells;
        EXPECT_EQ(below.upper.y, here.lower.y);
        EXPECT_LT(std::max(below.lower.x, here.lower.x), std::min(below.upper.x, here.upper.x));
      }
      EXPECT_TRUE(stack.size() == 1 || cells <= most);
    }
    EXPECT_EQ(met.size(), blocks.size());
  }
  EXPECT_EQ(stack_blocks(blocks, level, 1).size(), blocks.size());
  // Box 1 lies on box 0, box 2 on box 1; boxes 3, 4 and 5 begin stacks of their own.
  EXPECT_EQ(stack_blocks(blocks, level, 10000).size(), 4u);
}

TEST(PlaceBlocks, TheDefaultFitsTheLevel) {
  for (const IntVec3 cells : {IntVec3{4096, 1, 1}, {1, 300, 200}, {100, 20, 300}, {3, 1, 1}}) {
    const IntVec3 block = default_block(level_of(cells));
    const IntVec3 small = default_block(level_of(cells), BlockSize::small);
    for (int d = 0; d < 3; ++d) {
      EXPECT_GE(small[d], 1);
      EXPECT_LE(small[d], block[d]);
      EXPECT_LE(block[d], cells[d]);
    }
  }
}

// Boxes of a finer level are low and wide: their rows are kept whole where the cache allows.
TEST(PlaceBlocks, RowsOfFinerLevelsAreLonger) {
  Level level = level_of({1024, 1024, 1});
  EXPECT_EQ(default_block(level).x, 256);
  level.index = 1;
  EXPECT_GT(default_block(level).x, 256);
  Level three = level_of({256, 256, 256});
  const IntVec3 block = default_block(three);
  three.index = 1;
  EXPECT_EQ(default_block(three), block);
}

// Diffusion with an upwind part; keeps uniform states as they are. Reduces the largest value, the
// sum of what crosses the low x boundary, and a fault wherever a value exceeds 2.5.
struct Diffusion {
  TaskList list;
  VariableId old, now, slope, saved;
  std::atomic<int> rows = 0;

  explicit Diffusion(const Level& level) {
    old = list.old_state(test_label(1), 0, 1);
    now = list.new_state(test_label(1), 0, 1);
    slope = list.temporary("slope");
    const int low = level.domain.lower.x;
    const Axes axes = axes_of(level);
    TaskBuilder slopes = list.task("slopes", 0);
    const In q = slopes.read(old, Stencil::box(1));
    const Out s = slopes.write(slope);
    slopes.kernel([=, this](const Row& row) {
      ++rows;
      for (int i = 0; i < row.count(); ++i) {
        double sum = 0;
        for (int a = 0; a < axes.count; ++a) sum += row(q, 0, a, 1)[i] - row(q, 0, a, -1)[i];
        row(s)[i] = sum;
      }
    });
    TaskBuilder update = list.task("update", 0);
    const In in = update.read(old), ds = update.read(slope, Stencil::box(1));
    const Out out = update.write(now);
    update.kernel([=](const Row& row) {
      for (int i = 0; i < row.count(); ++i) {
        const double value = row(in)[i] +
                             0.01 * (row(ds, 0, 0, 1)[i] - 1.25 * row(ds, 0, 0, -1)[i]) +
                             0.003 * row(ds, 0, axes.count - 1, 1)[i];
        row(out)[i] = value;
        row.reductions().maximum(0, ordered_bits(value));
        IntVec3 cell = row.cell();
        cell.x += i;
        if (cell.x == low) row.reductions().sum(0).add(value);
        if (value > 2.5) row.reductions().fault({cell, 0, 0, 1, value});
      }
    });
  }
};

// Uniform left and right of a bump.
Warehouse bump(const Level& level) {
  Warehouse state(level, 0);
  const int slot = state.add({test_label(1), 0, 1, 2});
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView v = state.view(slot, 0, b);
    for_each_cell(v.box, [&](IntVec3 c) {
      v(c) = c.x < 40 ? 1.0 : c.x > 60 ? 0.5 : 1.0 + 0.1 * ((c.x * 7 + c.y * 3 + c.z) % 17);
    });
  }
  return state;
}

struct Outcome {
  std::vector<double> values;
  double maximum = 0, sum = 0;
  std::int64_t faults = 0, run = 0, skipped = 0, cells_skipped = 0;
  CellFault lowest;
  int rows = 0;

  // What must not depend on the way.
  void expect_equal(const Outcome& o) const {
    EXPECT_EQ(values, o.values);
    EXPECT_EQ(maximum, o.maximum);
    EXPECT_EQ(sum, o.sum);
    EXPECT_EQ(faults, o.faults);
    EXPECT_EQ(lowest.cell, o.lowest.cell);
  }
};

Outcome outcome(const Level& level, const SweepOptions& given, int passes = 1) {
  Diffusion graph(level);
  const Axes axes = axes_of(level);
  SweepOptions options = given;
  options.maxima = 1;
  options.sums = 1;
  SweepExecutor executor(graph.list, plan_sweep(graph.list, {0, 1}, axes), level, options);
  const Warehouse old = bump(level);
  Warehouse now(level, 0);
  const int slot = now.add({test_label(1), 0, 1, 2});
  executor.bind(old, now, nullptr);
  Outcome o;
  for (int n = 0; n < passes; ++n) {
    const Reductions& r = executor.run({});
    o.maximum = r.maximum(0);
    o.sum = r.sum(0).value();
    o.faults = r.fault_count();
    for (const CellFault& f : r.faults())
      if (&f == &r.faults().front() || before(f, o.lowest)) o.lowest = f;
  }
  o.run = executor.blocks_run();
  o.skipped = executor.blocks_skipped();
  o.cells_skipped = executor.cells_skipped();
  o.rows = graph.rows;
  o.values.resize(level.domain.volume());
  const IntVec3 n = level.domain.size();
  for (int b = 0; b < static_cast<int>(now.local_boxes().size()); ++b)
    for_each_cell(now.local_boxes()[b].cells, [&](IntVec3 c) {
      o.values[c.x + n.x * (c.y + n.y * c.z)] = now.view(slot, 0, b)(c);
    });
  return o;
}

class ExecutorOnShapes : public testing::TestWithParam<IntVec3> {};

TEST_P(ExecutorOnShapes, ThreadsBlocksAndSleepChangeNothing) {
  const IntVec3 cells = GetParam();
  const Level level = level_of(cells);
  const Outcome plain = outcome(level, {});
  EXPECT_GT(plain.faults, 0);  // so that faults are compared, too
  EXPECT_GT(plain.sum, 0);
  EXPECT_EQ(plain.skipped, 0);
  SweepOptions o;
  o.threads = 2;
  o.block = {8, 2, 2};
  plain.expect_equal(outcome(level, o));
  o.skip_uniform_blocks = true;
  const Outcome threads_asleep = outcome(level, o);
  plain.expect_equal(threads_asleep);
  o.threads = 1;
  const Outcome skipped = outcome(level, o);
  plain.expect_equal(skipped);
  EXPECT_GT(skipped.skipped, skipped.run);  // most of the level is quiet
  EXPECT_EQ(skipped.skipped, threads_asleep.skipped);
  EXPECT_EQ(skipped.cells_skipped, threads_asleep.cells_skipped);
  plain.expect_equal(outcome(level_of(cells, {3, cells.y > 1 ? 2 : 1, cells.z > 1 ? 2 : 1}), o));
}

INSTANTIATE_TEST_SUITE_P(Shapes, ExecutorOnShapes,
                         testing::Values(IntVec3{130, 1, 1}, IntVec3{130, 6, 1}, IntVec3{130, 1, 5},
                                         IntVec3{130, 4, 5}));

TEST(SweepExecutor, ASleepingBlockIsCheap) {
  SweepOptions o;
  o.block = {50, 50, 1};
  const Level level = level_of({250, 50, 1});
  const int awake = outcome(level, o).rows;
  o.skip_uniform_blocks = true;
  const Outcome skipped = outcome(level, o);
  EXPECT_EQ(skipped.skipped, 3);  // of five: the bump lies in [40, 60] and two cells around
  EXPECT_LT(skipped.rows, 2 * awake);
  EXPECT_EQ(skipped.run, 2);
  // All but cells at the boundary of the domain, and one of each block that stands for the rest.
  EXPECT_EQ(skipped.cells_skipped, 2 * (50 * 48 - 1) + 49 * 48 - 1);
}

TEST(SweepExecutor, ANanIsNotQuiet) {
  const Level level = level_of({64, 1, 1});
  Diffusion graph(level);
  SweepOptions o;
  o.skip_uniform_blocks = true;
  o.maxima = o.sums = 1;
  SweepExecutor executor(graph.list, plan_sweep(graph.list, {0, 1}, axes_of(level)), level, o);
  Warehouse old(level, 0), now(level, 0);
  const int slot = old.add({test_label(1), 0, 1, 2});
  now.add({test_label(1), 0, 1, 0});
  const RealView v = old.view(slot, 0, 0);
  for_each_cell(v.box, [&](IntVec3 c) { v(c) = std::numeric_limits<double>::quiet_NaN(); });
  executor.bind(old, now, nullptr);
  const Reductions& r = executor.run({});
  EXPECT_EQ(executor.blocks_skipped(), 0);
  EXPECT_TRUE(std::isnan(r.maximum(0)));  // NaN is the largest of all
}

TEST(SweepExecutor, SamplesEveryNthBlockAndScalesUp) {
  const Level level = level_of({130, 6, 1});
  Diffusion graph(level);
  SweepOptions o;
  o.block = {10, 6, 1};
  o.sample_every = 5;
  o.maxima = o.sums = 1;
  SweepExecutor executor(graph.list, plan_sweep(graph.list, {0, 1}, axes_of(level)), level, o);
  const Warehouse old = bump(level);
  Warehouse now(level, 0);
  now.add({test_label(1), 0, 1, 0});
  executor.bind(old, now, nullptr);
  for (int pass = 0; pass < 10; ++pass) executor.run({});
  EXPECT_EQ(executor.blocks_run(), 130);
  const std::vector<double> seconds = executor.task_seconds();
  ASSERT_EQ(seconds.size(), 2u);
  for (double s : seconds) {
    EXPECT_GT(s, 0);
    EXPECT_LT(s, 10);
  }
  EXPECT_GT(executor.scratch_bytes(), 0u);
}

TEST(SweepExecutor, WithoutSamplingNoTimeIsTold) {
  const Level level = level_of({20, 1, 1});
  Diffusion graph(level);
  SweepOptions o;
  o.maxima = o.sums = 1;
  SweepExecutor executor(graph.list, plan_sweep(graph.list, {0, 1}, axes_of(level)), level, o);
  const Warehouse old = bump(level);
  Warehouse now(level, 0);
  now.add({test_label(1), 0, 1, 0});
  executor.bind(old, now, nullptr);
  executor.run({});
  EXPECT_EQ(executor.task_seconds(), (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace sluice::sweep_executor_test
