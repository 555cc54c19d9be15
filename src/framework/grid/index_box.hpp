// A half-open box of cell indices, [lower, upper).
#pragma once
#include "framework/base/vec3.hpp"

namespace sluice {

struct IndexBox {
  IntVec3 lower{}, upper{};

  constexpr IntVec3 size() const { return upper - lower; }
  constexpr bool empty() const {
    return upper.x <= lower.x || upper.y <= lower.y || upper.z <= lower.z;
  }
  constexpr std::int64_t volume() const {
    if (empty()) return 0;
    const IntVec3 n = size();
    return static_cast<std::int64_t>(n.x) * n.y * n.z;
  }
  constexpr bool contains(IntVec3 c) const {
    return c.x >= lower.x && c.x < upper.x && c.y >= lower.y && c.y < upper.y && c.z >= lower.z &&
           c.z < upper.z;
  }
  constexpr bool contains(const IndexBox& b) const {
    return b.empty() || (min(b.lower, lower) == lower && max(b.upper, upper) == upper);
  }
  constexpr IndexBox grown(IntVec3 g) const { return {lower - g, upper + g}; }
  constexpr IndexBox grown(int direction, int low, int high) const {
    IndexBox b = *this;
    b.lower[direction] -= low;
    b.upper[direction] += high;
    return b;
  }
  constexpr IndexBox shifted(IntVec3 s) const { return {lower + s, upper + s}; }

  constexpr friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

constexpr IndexBox intersection(const IndexBox& a, const IndexBox& b) {
  return {max(a.lower, b.lower), min(a.upper, b.upper)};
}
constexpr IndexBox bounding(const IndexBox& a, const IndexBox& b) {
  return {min(a.lower, b.lower), max(a.upper, b.upper)};
}

// Calls f(IntVec3) for every cell, x fastest. For set-up and tools, not for the step.
template <class F>
void for_each_cell(const IndexBox& b, F&& f) {
  for (int k = b.lower.z; k < b.upper.z; ++k)
    for (int j = b.lower.y; j < b.upper.y; ++j)
      for (int i = b.lower.x; i < b.upper.x; ++i) f(IntVec3{i, j, k});
}

}  // namespace sluice
