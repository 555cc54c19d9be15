// The step reduction: what combining two records must give, in any order.
#include "framework/base/reduction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace sluice::reduction_test {
namespace {

struct Local {
  double low, high, part;
  std::int64_t tag, count;
  bool flag;
};

struct Slots {
  Reduction::Minimum low;
  Reduction::Maximum high;
  Reduction::Sum sum;
  Reduction::Count count;
  Reduction::Any any;
};

Slots fill(Reduction& reduction, const Local& local) {
  ExactSum sum;
  sum.add(local.part);
  return {reduction.add_minimum(local.low, local.tag), reduction.add_maximum(local.high, local.tag),
          reduction.add_sum(sum), reduction.add_count(local.count), reduction.add_any(local.flag)};
}

Slots combine_all(const std::vector<Local>& locals, Reduction& result) {
  const Slots slots = fill(result, locals.front());
  for (std::size_t i = 1; i < locals.size(); ++i) {
    Reduction other;
    fill(other, locals[i]);
    EXPECT_TRUE(
        Reduction::combine(other.words().data(), result.words().data(), result.words().size()));
  }
  return slots;
}

TEST(Reduction, combines_in_any_order) {
  std::vector<Local> locals = {{0.5, -3.0, 1e100, 7, 10, false},
                               {0.25, -2.0, 1.0, 9, 20, true},
                               {0.25, -2.0, -1e100, 4, 30, false}};
  for (int rotation = 0; rotation < 3; ++rotation) {
    Reduction result;
    const Slots slots = combine_all(locals, result);
    EXPECT_EQ(result.minimum(slots.low), 0.25);
    EXPECT_EQ(result.tag(slots.low), 4);
    EXPECT_EQ(result.maximum(slots.high), -2.0);
    EXPECT_EQ(result.tag(slots.high), 4);
    EXPECT_EQ(result.sum(slots.sum).value(), 1.0);
    EXPECT_EQ(result.count(slots.count), 60);
    EXPECT_TRUE(result.any(slots.any));
    std::rotate(locals.begin(), locals.begin() + 1, locals.end());
  }
}

TEST(Reduction, orders_all_doubles) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> ascending = {-infinity, -1e300, -2.0, -1e-310, -0.0,
                                         0.0,       1e-310, 2.0,  1e300,   infinity};
  for (std::size_t i = 0; i + 1 < ascending.size(); ++i) {
    Reduction result;
    const Slots slots = combine_all({{ascending[i + 1], ascending[i], 0, 1, 0, false},
                                     {ascending[i], ascending[i + 1], 0, 2, 0, false}},
                                    result);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(result.minimum(slots.low)),
              std::bit_cast<std::uint64_t>(ascending[i]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(result.maximum(slots.high)),
              std::bit_cast<std::uint64_t>(ascending[i + 1]));
    EXPECT_EQ(result.tag(slots.low), 2);
    EXPECT_EQ(result.tag(slots.high), 2);
  }
}

TEST(Reduction, a_nan_is_never_lost) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const bool first : {true, false}) {
    Reduction result;
    const Slots slots = combine_all({{first ? nan : 1.0, first ? nan : 1.0, 0, 0, 0, false},
                                     {first ? 1.0 : nan, first ? 1.0 : nan, 0, 0, 0, false}},
                                    result);
    EXPECT_TRUE(std::isnan(result.minimum(slots.low)));
    EXPECT_TRUE(std::isnan(result.maximum(slots.high)));
  }
}

TEST(Reduction, notices_different_slots) {
  Reduction a;
  a.add_minimum(1.0);
  a.add_count(3);
  Reduction b;
  b.add_maximum(1.0);
  b.add_count(3);
  EXPECT_TRUE(a.is_consistent());
  EXPECT_FALSE(Reduction::combine(b.words().data(), a.words().data(), a.words().size()));
  EXPECT_FALSE(a.is_consistent());
  Reduction good;
  good.add_minimum(1.0);
  good.add_count(3);
  EXPECT_FALSE(Reduction::combine(a.words().data(), good.words().data(), good.words().size()));
}

}  // namespace
}  // namespace sluice::reduction_test
