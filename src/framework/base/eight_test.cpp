// Eight lanes against one number after the other.
#include "framework/base/eight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "framework/base/largest.hpp"

namespace sluice::eight_test {
namespace {

constexpr std::size_t count = 29;  // three times eight and a rest
using Numbers = std::array<double, count + 1>;

Numbers numbers() {
  Numbers x;
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = std::sin(1.7 * static_cast<double>(n)) * 1e3;
  x[7] = -0.0;
  return x;
}

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

TEST(Eight, LanesHaveTheBitsOfSingleNumbers) {
  const Numbers x = numbers();
  for (std::size_t at = 0; at < 3; ++at) {
    const Eight all = EightOf{at}(x.data());
    const Eight sizes = magnitude(all), roots = square_root(magnitude(all));
    for (std::size_t l = 0; l < 8; ++l) {
      EXPECT_EQ(bits(all[l]), bits(OneOf{at + l}(x.data())));
      EXPECT_EQ(bits(sizes[l]), bits(std::fabs(x[at + l])));
      EXPECT_EQ(bits(roots[l]), bits(std::sqrt(std::fabs(x[at + l]))));
    }
  }
  Numbers copy{};
  put_eight(eight_at(&x[3]), &copy[5]);
  EXPECT_TRUE(std::equal(x.begin() + 3, x.begin() + 11, copy.begin() + 5));
  EXPECT_EQ(copy[4], 0);
  EXPECT_EQ(copy[13], 0);
}

TEST(Largest, IsThatOfASortedList) {
  const Numbers x = numbers();
  for (std::size_t begin = 0; begin < 9; ++begin)
    for (std::size_t end = begin; end <= count; ++end) {
      Numbers sorted = x;
      std::sort(sorted.begin() + begin, sorted.begin() + end);
      const double most = end > begin ? std::max(-2e3, sorted[end - 1]) : -2e3;
      EXPECT_EQ(largest(begin, end, -2e3, [&](auto at) { return at(x.data()); }), most);
    }
}

TEST(Most, PassesOverWhatIsNoNumber) {
  Numbers x = numbers();
  x[4] = x[26] = std::nan("");
  Most most(-1);
  for_eights(1, count, [&](auto at) { most.add(at(x.data())); });
  double expected = -1;
  for (std::size_t n = 1; n < count; ++n) expected = std::fmax(expected, x[n]);
  EXPECT_EQ(most.value(), expected);
}

TEST(Eight, RoundsAndComparesAsSingleNumbers) {
  Numbers x = numbers();
  for (std::size_t n = 0; n < x.size(); ++n) x[n] *= n % 3 == 0 ? 1e-3 : 0.5;
  x[2] = 2.5;
  x[3] = -3.5;
  std::array<std::int32_t, count + 1> whole{};
  for_eights(0, count, [&](auto at) { at.put(rounded_to_even(at(x.data())), whole.data()); });
  for (std::size_t n = 0; n < count; ++n) EXPECT_EQ(whole[n], std::lrint(x[n]));
  const Eight a = eight_at(&x[0]), b = eight_at(&x[8]);
  const Eight low = smaller(a, b), high = larger(a, b), floor = rounded_down(a);
  double sum = 0;
  for (int l = 0; l < 8; ++l) {
    EXPECT_EQ(low[l], std::min(x[l], x[8 + l]));
    EXPECT_EQ(high[l], std::max(x[l], x[8 + l]));
    EXPECT_EQ(floor[l], std::floor(x[l]));
    EXPECT_EQ(each(a, [](double y) { return std::exp(y * 1e-3); })[l], std::exp(x[l] * 1e-3));
    sum += x[l];
  }
  EXPECT_NEAR(sum_of_lanes(a), sum, 1e-10);
}

TEST(Largest, IsNoNumberWhereOneIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
    for (std::size_t n = 0; n < count; ++n) {
      Numbers x = numbers();
      x[n] = bad;
      EXPECT_TRUE(std::isnan(largest(0, count, 0, [&](auto at) { return at(x.data()); }))) << n;
      EXPECT_FALSE(std::isnan(largest(n + 1, count, 0, [&](auto at) { return at(x.data()); })));
    }
}

}  // namespace
}  // namespace sluice::eight_test
