// Ranges cover all numbers once, and sums of threads are those of one.
#include "mpmice/fields/thread_ranges.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::thread_ranges_test {
namespace {

TEST(ThreadRanges, CoverAllNumbersOnce) {
  for (const int threads : {1, 3})
    for (const std::size_t count : {std::size_t{0}, std::size_t{7}, std::size_t{10000}}) {
      const ThreadTeam team(threads);
      std::vector<std::atomic<int>> seen(count);
      std::atomic<std::size_t> ranges = 0;
      for_each_range(team, count, [&](std::size_t begin, std::size_t end, std::size_t, int) {
        ++ranges;
        for (std::size_t n = begin; n < end; ++n) ++seen[n];
      });
      EXPECT_EQ(ranges, range_count(team, count));
      for (const auto& n : seen) EXPECT_EQ(n, 1);
    }
}

TEST(ThreadRanges, SumsDoNotDependOnThreads) {
  const BlockInCells<1> block(64, 1, 20, 30);
  const CellBlocks<1>& cells = block.near.frame().cells;
  std::vector<std::vector<std::uint64_t>> sums;
  for (const int threads : {1, 2, 5}) {
    const ThreadTeam team(threads);
    CellSums<1> to;
    to.begin(cells, 2);
    to.lane(1)[cells.index({25})] = 3;
    add_in_ranges<1>(team, 5000, to,
                     [&](std::size_t begin, std::size_t end, std::size_t, CellSums<1>& own) {
                       for (std::size_t n = begin; n < end; ++n)
                         own.lane(0)[cells.index({20 + static_cast<int>(n % 10)})] += n * n;
                     });
    sums.emplace_back(to.lane(0), to.lane(0) + 2 * cells.size());
  }
  EXPECT_EQ(sums[0], sums[1]);
  EXPECT_EQ(sums[0], sums[2]);
  EXPECT_EQ(sums[0][cells.size() + cells.index({25})], 3u);
}

TEST(NearCells, AtOnceMeetsEachCellOfTheDomain) {
  BlockInCells<2> block(32, 1, 0, 6);
  const ThreadTeam team(3);
  block.near.begin(&team);
  block.sets.add_cells(block.near.frame(), 1, block.near.begin(&team));
  block.near.finish(block.level, block.level.boxes, world());
  std::vector<std::atomic<int>> seen(block.near.size());
  block.near.for_each_at_once([&](const Cell<2>& c, std::size_t i) {
    EXPECT_EQ(block.at(c), i);
    ++seen[i];
  });
  int cells = 0;
  block.near.for_each([&](const Cell<2>&, std::size_t i) {
    ++cells;
    EXPECT_EQ(seen[i], 1);
  });
  int all = 0;
  for (const auto& n : seen) all += n;
  EXPECT_EQ(all, cells);
}

}  // namespace
}  // namespace sluice::mpmice::thread_ranges_test
