// Packing exact sums, and arithmetic with pairs of doubles.
#include "framework/analysis/sums.hpp"

#include <cmath>

namespace sluice {
namespace {

constexpr std::size_t words = ExactSum::slot_count, chunks = ExactSum::chunk_count;

bool has_specials(const ExactSum::Slots& slots) {
  return slots[chunks] != 0 || slots[chunks + 1] != 0 || slots[chunks + 2] != 0;
}

Double2 two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

}  // namespace

// Words are below 2^32: doubles hold them exactly. Of negative sums, whose high words are all
// filled, the opposite is packed, with a negative count.
void pack_sum(const ExactSum& sum, std::vector<double>& numbers) {
  ExactSum::Slots slots = sum.canonical();
  const bool negative = slots[chunks - 1] < 0 && !has_specials(slots);
  if (negative) {
    ExactSum opposite;
    opposite.subtract(sum);
    slots = opposite.canonical();
  }
  std::size_t first = 0, end = words;
  while (first < end && slots[first] == 0) ++first;
  while (end > first && slots[end - 1] == 0) --end;
  numbers.push_back(static_cast<double>(first));
  numbers.push_back(static_cast<double>(end - first) * (negative ? -1.0 : 1.0));
  for (std::size_t w = first; w < end; ++w) numbers.push_back(static_cast<double>(slots[w]));
}

ExactSum take_sum(RankNumbers& numbers) {
  ExactSum total;
  for (int r = 0; r < numbers.ranks(); ++r) {
    const double* head = numbers.take(r, 2);
    const auto first = static_cast<std::size_t>(head[0]);
    const auto count = static_cast<std::size_t>(std::fabs(head[1]));
    const bool negative = head[1] < 0;
    const double* packed = numbers.take(r, count);
    ExactSum::Slots slots{};
    for (std::size_t w = 0; w < count; ++w) slots[first + w] = static_cast<std::int64_t>(packed[w]);
    if (negative)
      total.subtract(ExactSum::from_slots(slots));
    else
      total.merge(ExactSum::from_slots(slots));
  }
  return total;
}

Double2 value2(const ExactSum& sum) {
  const double high = sum.value();
  ExactSum rest = sum;
  rest.add(-high);
  return {high, std::isfinite(high) ? rest.value() : 0.0};
}

Double2 operator+(Double2 a, Double2 b) {
  const Double2 s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
  const Double2 u = two_sum(s.high, s.low + t.high);
  return two_sum(u.high, u.low + t.low);
}

Double2 operator-(Double2 a, Double2 b) {
  return a + Double2{-b.high, -b.low};
}

Double2 product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

Double2 operator*(Double2 a, Double2 b) {
  const Double2 p = product(a.high, b.high);
  return two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

}  // namespace sluice
