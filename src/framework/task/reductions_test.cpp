// Maxima, sums and faults do not depend on the order in which they are merged.
#include "framework/task/reductions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "framework/task/reduction_layout.hpp"

namespace sluice::reductions_test {
namespace {

TEST(Reductions, OrderedBitsKeepTheOrderAndPutNanOnTop) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> rising = {
      0, std::numeric_limits<double>::denorm_min(), 1e-300, 1.0, 1.5, 1e300, infinity, nan};
  for (std::size_t n = 1; n < rising.size(); ++n)
    EXPECT_LT(ordered_bits(rising[n - 1]), ordered_bits(rising[n]));
  EXPECT_EQ(from_ordered_bits(ordered_bits(0.1)), 0.1);
}

TEST(Reductions, MergeInAnyOrderGivesTheSameBits) {
  std::mt19937 random(5);
  std::vector<Reductions> parts(8, Reductions(2, 2));
  for (int n = 0; n < 400; ++n) {
    Reductions& r = parts[random() % parts.size()];
    const double q =
        std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 120) - 60);
    r.sum(0).add(q);
    r.sum(1).add(-q * q);
    r.maximum(static_cast<int>(random() % 2), ordered_bits(std::fabs(q)));
    if (n % 40 == 0) r.fault({{n, n % 3, 0}, 0, 0, 0, q});
  }
  const auto merged = [&](const std::vector<std::size_t>& order) {
    Reductions all(2, 2);
    for (std::size_t p : order) all.merge(parts[p]);
    return all;
  };
  std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5, 6, 7};
  const Reductions first = merged(order);
  const auto lowest = [](const Reductions& r) {
    return *std::min_element(r.faults().begin(), r.faults().end(), before);
  };
  EXPECT_EQ(first.fault_count(), 10);
  for (int n = 0; n < 20; ++n) {
    std::shuffle(order.begin(), order.end(), random);
    const Reductions other = merged(order);
    for (int s = 0; s < 2; ++s) {
      EXPECT_EQ(other.sum(s).value(), first.sum(s).value());
      EXPECT_EQ(other.maximum(s), first.maximum(s));
    }
    EXPECT_EQ(other.fault_count(), first.fault_count());
    EXPECT_EQ(lowest(other).cell, lowest(first).cell);
  }
}

TEST(Reductions, ClearForgetsEverything) {
  Reductions r(1, 1);
  r.maximum(0, ordered_bits(3));
  r.sum(0).add(2);
  r.fault({});
  r.clear();
  EXPECT_EQ(r.maximum(0), 0);
  EXPECT_EQ(r.sum(0).value(), 0);
  EXPECT_EQ(r.fault_count(), 0);
  EXPECT_EQ(r.maxima_count(), 1);
  EXPECT_EQ(r.sum_count(), 1);
}

TEST(CellFault, OrderIsLevelThenPlaneThenRow) {
  const CellFault a{{9, 9, 0}, 0, 0, 0, 1}, b{{0, 0, 1}, 0, 0, 0, 1}, c{{0, 0, 0}, 1, 0, 0, 1};
  EXPECT_TRUE(before(a, b));
  EXPECT_TRUE(before(b, c));
  EXPECT_FALSE(before(c, a));
  const CellFault d{{1, 9, 0}, 0, 0, 0, 1}, e{{2, 9, 0}, 0, 0, 0, 1};
  EXPECT_TRUE(before(d, e));
  const CellFault f{{1, 9, 0}, 0, 0, 2, 1};
  EXPECT_TRUE(before(d, f));
  EXPECT_FALSE(before(d, d));
}

// Sums of stages are those that no sweep adds to, wherever they stand.
TEST(ReductionLayout, KnowsTheSumsOfStages) {
  ReductionLayout layout;
  const SumGroup solids = layout.add_sums_of_stages(3), fluid = layout.add_sums(2),
                 burned = layout.add_sums_of_stages(1);
  EXPECT_EQ(layout.sums(), 6);
  EXPECT_EQ(fluid.first(), 3);
  for (int s = 0; s < 6; ++s)
    EXPECT_EQ(layout.is_of_stages(s), s < solids.count() || s == burned.first()) << s;
}

}  // namespace
}  // namespace sluice::reductions_test
