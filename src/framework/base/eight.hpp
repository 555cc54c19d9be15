// Eight numbers side by side: one register of AVX-512, two of AVX2.
//
// Sums, products, quotients and square roots of lanes are rounded as those of single numbers, so
// that a function of T gives each lane the bits that it gives a double. What is written for both
// takes its numbers from columns by OneOf or EightOf, and says magnitude() and square_root() for
// std::fabs() and std::sqrt().
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sluice {

using Eight = double __attribute__((vector_size(64)));
using EightBits = std::uint64_t __attribute__((vector_size(64)));
using EightWhole = std::int32_t __attribute__((vector_size(32), may_alias, aligned(4)));
using EightInMemory = double __attribute__((vector_size(64), may_alias, aligned(8)));

// Numbers at, ..., at + 7 of a column.
[[gnu::always_inline]] inline Eight eight_at(const double* at) {
  return *reinterpret_cast<const EightInMemory*>(at);
}
[[gnu::always_inline]] inline void put_eight(const Eight& x, double* at) {
  *reinterpret_cast<EightInMemory*>(at) = x;
}

[[gnu::always_inline]] inline double magnitude(double x) {
  return std::fabs(x);
}
[[gnu::always_inline]] inline Eight magnitude(const Eight& x) {
  constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);
  return reinterpret_cast<Eight>(reinterpret_cast<EightBits>(x) & without_sign);
}
[[gnu::always_inline]] inline double square_root(double x) {
  return std::sqrt(x);
}
[[gnu::always_inline]] inline Eight square_root(const Eight& x) {
  return Eight{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3]),
               std::sqrt(x[4]), std::sqrt(x[5]), std::sqrt(x[6]), std::sqrt(x[7])};
}

// std::max() and std::min(): the first where both are equal.
template <class T>
[[gnu::always_inline]] inline T larger(const T& a, const T& b) {
  return a < b ? b : a;
}
template <class T>
[[gnu::always_inline]] inline T smaller(const T& a, const T& b) {
  return b < a ? b : a;
}
// std::floor(), and std::nearbyint() to the nearest, even.
[[gnu::always_inline]] inline double rounded_down(double x) {
  return std::floor(x);
}
[[gnu::always_inline]] inline Eight rounded_down(const Eight& x) {
  return Eight{std::floor(x[0]), std::floor(x[1]), std::floor(x[2]), std::floor(x[3]),
               std::floor(x[4]), std::floor(x[5]), std::floor(x[6]), std::floor(x[7])};
}
[[gnu::always_inline]] inline double rounded_to_even(double x) {
  return std::nearbyint(x);
}
[[gnu::always_inline]] inline Eight rounded_to_even(const Eight& x) {
  return Eight{std::nearbyint(x[0]), std::nearbyint(x[1]), std::nearbyint(x[2]),
               std::nearbyint(x[3]), std::nearbyint(x[4]), std::nearbyint(x[5]),
               std::nearbyint(x[6]), std::nearbyint(x[7])};
}

[[gnu::always_inline]] inline double sum_of_lanes(double x) {
  return x;
}
[[gnu::always_inline]] inline double sum_of_lanes(const Eight& x) {
  return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}

// f of each lane, where f is no arithmetic: functions of the mathematical library.
template <class F>
[[gnu::always_inline]] inline double each(double x, F&& f) {
  return f(x);
}
template <class F>
[[gnu::always_inline]] inline Eight each(const Eight& x, F&& f) {
  Eight y = x;
  for (int l = 0; l < 8; ++l) y[l] = f(x[l]);
  return y;
}

// Places in columns: of number i, of those from i to i + 7. A loop that is written with them takes
// eight at a time and then what is left one by one.
struct OneOf {
  using Number = double;
  static constexpr std::size_t count = 1;
  std::size_t i;

  OneOf behind(std::size_t first) const { return {first + i}; }
  [[gnu::always_inline]] double operator()(const double* column) const { return column[i]; }
  [[gnu::always_inline]] void put(double x, double* column) const { column[i] = x; }
  [[gnu::always_inline]] void put(double x, std::int32_t* column) const {
    column[i] = static_cast<std::int32_t>(x);
  }
};
struct EightOf {
  using Number = Eight;
  static constexpr std::size_t count = 8;
  std::size_t i;

  EightOf behind(std::size_t first) const { return {first + i}; }
  [[gnu::always_inline]] Eight operator()(const double* column) const {
    return eight_at(column + i);
  }
  [[gnu::always_inline]] void put(const Eight& x, double* column) const {
    put_eight(x, column + i);
  }
  [[gnu::always_inline]] void put(const Eight& x, std::int32_t* column) const {
    *reinterpret_cast<EightWhole*>(column + i) = __builtin_convertvector(x, EightWhole);
  }
};

// act(EightOf or OneOf) for the numbers from begin to end - 1.
template <class Act>
[[gnu::always_inline]] inline void for_eights(std::size_t begin, std::size_t end, Act&& act) {
  std::size_t i = begin;
  for (; i + 8 <= end; i += 8) act(EightOf{i});
  for (; i < end; ++i) act(OneOf{i});
}

}  // namespace sluice
