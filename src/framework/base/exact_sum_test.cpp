// ExactSum against big-integer arithmetic, known cancellations, permutations and merges.
#include "framework/base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace sluice::exact_sum_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

// The sum by bits, slowly and differently: sign-magnitude numbers of one bit a byte.
class BitSum {
 public:
  void add(double x) {
    int exponent = 0;
    const double fraction = std::frexp(std::fabs(x), &exponent);
    auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    std::vector<int> number(bits, 0);
    for (int i = 0; i < 53; ++i, mantissa >>= 1) {
      const int position = exponent - 53 + i + offset;
      if ((mantissa & 1) != 0) number[position] = 1;
    }
    for (std::size_t i = 0; i < bits; ++i) digits_[i] += x < 0 ? -number[i] : number[i];
  }

  double value() const {
    std::vector<long> digits = digits_;
    bool negative = false;
    normalise(digits);
    if (digits.back() < 0) {
      negative = true;
      digits = digits_;
      for (long& digit : digits) digit = -digit;
      normalise(digits);
    }
    int top = static_cast<int>(bits) - 1;
    while (top >= 0 && digits[top] == 0) --top;
    if (top < 0) return 0.0;
    const int low = std::max(top - 52, offset - 1074);
    double result = 0.0;
    for (int i = top; i >= low; --i) {
      result = 2.0 * result + static_cast<double>(digits[i]);
    }
    bool half = low > 0 && digits[low - 1] != 0;
    bool below = false;
    for (int i = 0; i < low - 1; ++i) below = below || digits[i] != 0;
    if (half && (below || std::fmod(result, 2.0) != 0.0)) result += 1.0;
    result = std::ldexp(result, low - offset);
    return negative ? -result : result;
  }

 private:
  static constexpr int offset = 1130;  // bit i has the weight 2^(i - offset)
  static constexpr std::size_t bits = 2240;

  static void normalise(std::vector<long>& digits) {
    for (std::size_t i = 0; i + 1 < digits.size(); ++i) {
      const long carry = digits[i] >> 1;
      digits[i] -= 2 * carry;
      digits[i + 1] += carry;
    }
  }

  std::vector<long> digits_ = std::vector<long>(bits, 0);
};

double sum_of(const std::vector<double>& values) {
  ExactSum one_by_one;
  for (const double x : values) one_by_one.add(x);
  ExactSum at_once;
  at_once.add(values.data(), values.size());
  EXPECT_EQ(one_by_one, at_once);
  return at_once.value();
}

// Random doubles, exponents uniform in [low, high], both signs.
std::vector<double> random_values(std::size_t count, int low, int high, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(1.0, 2.0);
  std::uniform_int_distribution<int> exponent(low, high);
  std::vector<double> values(count);
  for (double& x : values) {
    x = std::ldexp(mantissa(random), exponent(random));
    if ((random() & 1) != 0) x = -x;
  }
  return values;
}

TEST(ExactSum, known_exact_cases) {
  EXPECT_EQ(sum_of({}), 0.0);
  EXPECT_EQ(sum_of({1e100, 1.0, -1e100}), 1.0);
  EXPECT_EQ(sum_of({1e308, 1e308, -1e308, -1e308, smallest}), smallest);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.3}), std::ldexp(1.0, -55));  // their doubles differ by this
  EXPECT_EQ(sum_of(std::vector<double>(10, 0.1)), 1.0);       // naive: 0.9999999999999999
  EXPECT_EQ(sum_of(std::vector<double>(1000000, 0.1)), 100000.0);
  EXPECT_EQ(sum_of({largest, -smallest}), largest);
  EXPECT_EQ(sum_of({-largest, -largest, largest}), -largest);
  EXPECT_EQ(sum_of({-2.5, 1.0}), -1.5);
}

TEST(ExactSum, rounds_to_nearest_even_once) {
  const double half_ulp = std::ldexp(1.0, -53);
  EXPECT_EQ(sum_of({1.0, half_ulp}), 1.0);
  EXPECT_EQ(sum_of({1.0 + 2 * half_ulp, half_ulp}), 1.0 + 4 * half_ulp);
  EXPECT_EQ(sum_of({1.0, half_ulp, smallest}), 1.0 + 2 * half_ulp);
  EXPECT_EQ(sum_of({1.0, half_ulp, -smallest}), 1.0);
  EXPECT_EQ(sum_of({2.0 - 2 * half_ulp, half_ulp}), 2.0);  // carry into the next binade
}

TEST(ExactSum, subnormals_and_overflow) {
  const double smallest_normal = std::numeric_limits<double>::min();
  EXPECT_EQ(sum_of({smallest, smallest, smallest}), 3 * smallest);
  EXPECT_EQ(sum_of({smallest_normal, -smallest}), smallest_normal - smallest);
  EXPECT_EQ(sum_of({smallest_normal / 2, smallest_normal / 2}), smallest_normal);
  EXPECT_EQ(sum_of({smallest_normal, smallest_normal, smallest}), 2 * smallest_normal + smallest);
  EXPECT_EQ(sum_of({largest, largest}), infinity);
  EXPECT_EQ(sum_of({-largest, -largest}), -infinity);
  EXPECT_EQ(sum_of({largest, largest, -largest}), largest);  // an intermediate overflow is none
  const double half_last = std::ldexp(1.0, 970);             // half a unit in the last place
  EXPECT_EQ(sum_of({largest, half_last}), infinity);
  EXPECT_EQ(sum_of({largest, half_last, -smallest}), largest);
}

TEST(ExactSum, nan_and_infinity_are_sticky) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sum_of({1.0, infinity, -5.0}), infinity);
  EXPECT_EQ(sum_of({1.0, -infinity, 1e300}), -infinity);
  EXPECT_TRUE(std::isnan(sum_of({infinity, 1.0, -infinity})));
  EXPECT_TRUE(std::isnan(sum_of({1.0, nan, infinity})));
  std::vector<double> many(5000, 1.0);
  many[3777] = nan;
  EXPECT_TRUE(std::isnan(sum_of(many)));
  many[3777] = -infinity;
  EXPECT_EQ(sum_of(many), -infinity);
}

TEST(ExactSum, a_sum_of_zeros_is_plus_zero) {
  EXPECT_FALSE(std::signbit(sum_of({-0.0})));
  EXPECT_FALSE(std::signbit(sum_of(std::vector<double>(3000, -0.0))));
  EXPECT_FALSE(std::signbit(sum_of({1.5, -1.5})));
}

TEST(ExactSum, agrees_with_bitwise_arithmetic) {
  struct Range {
    int low, high;
  };
  for (const Range range : {Range{-5, 5}, Range{-60, 60}, Range{-1074, -1000}, Range{900, 1020},
                            Range{-1074, 1020}, Range{-20, 20}}) {
    for (unsigned seed = 0; seed < 8; ++seed) {
      std::vector<double> values = random_values(50 + 17 * seed, range.low, range.high, seed);
      if (seed % 2 == 1) {  // near cancellation: the negatives again, slightly short
        const std::size_t count = values.size();
        for (std::size_t i = 3; i < count; ++i) values.push_back(-values[i]);
      }
      BitSum reference;
      for (const double x : values) reference.add(x);
      EXPECT_EQ(sum_of(values), reference.value()) << range.low << " " << range.high << " " << seed;
    }
  }
}

TEST(ExactSum, order_changes_no_bit) {
  for (const int spread : {1, 30, 80, 160, 1000}) {
    std::vector<double> values = random_values(5000, -spread, std::min(spread, 1000), 11);
    const double expected = sum_of(values);
    std::mt19937_64 random(5);
    for (int trial = 0; trial < 5; ++trial) {
      std::shuffle(values.begin(), values.end(), random);
      EXPECT_EQ(sum_of(values), expected);
    }
    std::sort(values.begin(), values.end());
    EXPECT_EQ(sum_of(values), expected);
  }
}

TEST(ExactSum, splitting_and_merging_change_no_bit) {
  const std::vector<double> values = random_values(4097, -40, 40, 3);
  const double expected = sum_of(values);
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<ExactSum> parts(7);
    for (const double x : values) parts[random() % parts.size()].add(x);
    ExactSum left;  // ((a + b) + c) + ...
    for (const ExactSum& part : parts) left.merge(part);
    ExactSum right;  // a + (b + (c + ...))
    for (std::size_t i = parts.size(); i-- > 0;) {
      ExactSum sum = parts[i];
      sum.merge(right);
      right = sum;
    }
    ExactSum::Slots words{};  // as ranks are combined: word by word
    for (const ExactSum& part : parts) {
      const ExactSum::Slots slots = part.canonical();
      for (std::size_t i = 0; i < slots.size(); ++i) words[i] += slots[i];
    }
    EXPECT_EQ(left, right);
    EXPECT_EQ(left, ExactSum::from_slots(words));
    EXPECT_EQ(left.value(), expected);
  }
}

TEST(ExactSum, merging_the_same_many_times_overflows_nothing) {
  ExactSum sum;
  ExactSum part;
  part.add(-largest);
  part.add(3.0);
  for (int i = 0; i < 100000; ++i) sum.merge(part);
  for (int i = 0; i < 100000; ++i) sum.add(largest);
  EXPECT_EQ(sum.value(), 300000.0);
}

TEST(ExactSum, merging_full_sums_overflows_nothing) {
  // Each part stands just before its carries are due, all mantissa bits set, the same chunk.
  const double x = std::nextafter(std::ldexp(1.0, 31), 0.0);
  ExactSum part;
  for (int i = 0; i < 2045; ++i) part.add(x);
  ExactSum sum;
  for (int i = 0; i < 64; ++i) sum.merge(part);
  for (int i = 0; i < 32; ++i) sum.subtract(part);
  ExactSum reference;
  for (int i = 0; i < 32 * 2045; ++i) reference.add(x);
  EXPECT_EQ(sum, reference);
}

TEST(ExactSum, subtracting_undoes_merging) {
  const std::vector<double> values = random_values(3000, -40, 40, 5);
  ExactSum first, second;
  first.add(values.data(), 2000);
  second.add(values.data() + 2000, 1000);
  ExactSum both = first;
  both.merge(second);
  both.subtract(first);
  EXPECT_EQ(both, second);
  both.subtract(second);
  EXPECT_EQ(both, ExactSum());
  EXPECT_EQ(both.value(), 0.0);
  for (int i = 0; i < 5000; ++i) both.subtract(second);
  for (int i = 0; i < 5001; ++i) both.merge(second);
  EXPECT_EQ(both, second);
  ExactSum infinite;
  infinite.add(infinity);
  both.subtract(infinite);
  EXPECT_EQ(both.value(), -infinity);
}

TEST(ExactSum, merge_carries_the_special_values) {
  ExactSum sum;
  sum.add(1.0);
  ExactSum other;
  other.add(infinity);
  sum.merge(other);
  EXPECT_EQ(sum.value(), infinity);
  ExactSum third;
  third.add(-infinity);
  sum.merge(third);
  EXPECT_TRUE(std::isnan(sum.value()));
}

TEST(ExactSum, million_equal_signs_stay_exact) {
  // The deferred carries at their limit: mantissas of all ones, the same chunk each time.
  const double x = std::nextafter(std::ldexp(1.0, 31), 0.0);
  ExactSum sum;
  for (int i = 0; i < (1 << 20); ++i) sum.add(-x);
  EXPECT_EQ(sum.value(), -std::ldexp(x, 20));
}

}  // namespace
}  // namespace sluice::exact_sum_test
