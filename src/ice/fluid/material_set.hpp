// Sets of materials as numbers in cells, without unit.
#pragma once
#include <bit>
#include <cstdint>

namespace sluice::ice {

// A bit per material: exact in a double up to 2^53.
constexpr int max_materials = 32;
inline double only(int material) {
  return static_cast<double>(std::uint64_t{1} << material);
}
inline std::uint64_t as_set(double presence) {
  return static_cast<std::uint64_t>(presence);
}
inline bool is_single(double presence) {
  return std::has_single_bit(as_set(presence));
}
inline int first_of(double presence) {
  return std::countr_zero(as_set(presence));
}
// The material of a set of one, -1 of any other: without a branch, for rows. Such a set is a power
// of two, and its exponent the material.
inline double single_of(double presence) {
  constexpr int digits = 52, bias = 1023;
  const auto bits = std::bit_cast<std::int64_t>(presence);
  const std::int64_t beyond = bits & ((std::int64_t{1} << digits) - 1);
  const std::int64_t material = (bits >> digits) - bias;
  return static_cast<double>(beyond == 0 && bits != 0 ? material : -1);
}

template <class F>
void for_each_of(std::uint64_t set, F&& f) {
  for (; set != 0; set &= set - 1) f(std::countr_zero(set));
}

}  // namespace sluice::ice
