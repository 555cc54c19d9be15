// Sums on nodes as exact integers: the same bits in any order of particles, threads and ranks.
//
// A contribution c to a field enters as the integer round(c 2^k), with one k for each field, from a
// proven bound of |c| (docs/theory/mpm_transfers.md, "Sums"). Rounding is done by adding 1.5 2^52
// and taking the bits: the last lane of a node adds the bits of that number alone, as often as
// anything is added, and is subtracted at the end.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "framework/base/eight.hpp"
#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

// Half of a node: four lanes, of any unit.
using Four = double __attribute__((vector_size(32)));
// Of whole numbers that wrap, as unsigned ones may.
using FourBits = std::uint64_t __attribute__((vector_size(32)));
using FourAtNode = double __attribute__((vector_size(32), may_alias));
using FourBitsAtNode = std::uint64_t __attribute__((vector_size(32), may_alias));
// A whole node: Eight, in memory.
using EightAtNode = double __attribute__((vector_size(64), may_alias));
using EightBitsAtNode = std::uint64_t __attribute__((vector_size(64), may_alias));

inline constexpr double rounding_number = 0x1.8p52;  // 1.5 2^52
inline constexpr std::int64_t rounding_bits = std::bit_cast<std::int64_t>(rounding_number);
inline constexpr int count_lane = lanes - 1;
// Contributions that the lanes of a node take without overflow.
inline constexpr std::int64_t max_contributions = 4096;

// Lanes wrap: what they sum is right modulo 2^64.
inline std::int64_t wrapped_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
inline std::int64_t wrapped_difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

inline void add_rounded(std::int64_t* node, Four value) {
  const Four rounded = value + rounding_number;
  auto* to = reinterpret_cast<FourBitsAtNode*>(node);
  *to += reinterpret_cast<FourBits>(rounded);
}

inline Eight joined(const Four& low, const Four& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline void add_rounded(std::int64_t* node, const Eight& value) {
  const Eight rounded = value + rounding_number;
  auto* to = reinterpret_cast<EightBitsAtNode*>(node);
  *to += reinterpret_cast<EightBits>(rounded);
}

// 2^k for contributions of at most `bound`; 1 where all are zero.
inline double scale_for(double bound) {
  if (!(bound > 0)) return 1;
  int exponent = 0;
  std::frexp(bound, &exponent);  // bound < 2^exponent
  return std::ldexp(1.0, 50 - exponent);
}

// Number of contributions to a node.
inline std::int64_t contributions(const std::int64_t* node) {
  // rounding_bits = 0x867 2^51 and 2^13 = 0: the inverse of its odd part, modulo 2^13.
  constexpr std::uint64_t odd = static_cast<std::uint64_t>(rounding_bits) >> 51;
  constexpr std::uint64_t mask = 0x1fff;
  constexpr auto inverse = [] {
    std::uint64_t x = odd;
    for (int i = 0; i < 5; ++i) x *= 2 - odd * x;
    return x & mask;
  }();
  return static_cast<std::int64_t>(
      ((static_cast<std::uint64_t>(node[count_lane]) >> 51) * inverse) & mask);
}

// The sum in a lane, in units of 2^-k.
inline double sum_in(const std::int64_t* node, int lane) {
  return static_cast<double>(wrapped_difference(node[lane], node[count_lane]));
}

inline double as_real(std::int64_t bits) {
  return std::bit_cast<double>(bits);
}
inline std::int64_t as_bits(double x) {
  return std::bit_cast<std::int64_t>(x);
}

}  // namespace sluice::mpm
