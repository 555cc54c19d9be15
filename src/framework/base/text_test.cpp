// Text of numbers reads back to the same bits, whatever they are.
#include "framework/base/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace sluice::text_test {
namespace {

TEST(Text, numbers_have_the_digits_that_are_promised) {
  EXPECT_EQ(shortest_text(0.1), "0.1");
  EXPECT_EQ(shortest_text(-2.0), "-2");
  EXPECT_EQ(shortest_text(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(exact_text(0.1), "0.10000000000000001");
  EXPECT_EQ(exact_text(1.0), "1");
  EXPECT_EQ(exact_text(101325.0), "101325");
  EXPECT_EQ(exact_text(1.0 / 3.0), "0.33333333333333331");
  EXPECT_EQ(shortest_text(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Text, numbers_read_back_to_the_same_bits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(shortest_text(x).c_str(), nullptr)), bits);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(exact_text(x).c_str(), nullptr)), bits);
  }
}

TEST(Text, join_puts_separators_between) {
  EXPECT_EQ(join({}, ", "), "");
  EXPECT_EQ(join({"a", "b", "c"}, ", "), "a, b, c");
}

}  // namespace
}  // namespace sluice::text_test
