// How cells and nodes are cut into blocks of 64 along the active directions: 4^3, 8^2 or 64.
#pragma once
#include <array>

#include "framework/base/vec3.hpp"

namespace sluice {

struct BlockShape {
  IntVec3 edge{4, 4, 4};   // powers of two
  IntVec3 shift{2, 2, 2};  // their exponents

  IntVec3 block_of(IntVec3 at) const { return {at.x >> shift.x, at.y >> shift.y, at.z >> shift.z}; }
  IntVec3 lower(IntVec3 block) const {
    return {block.x * edge.x, block.y * edge.y, block.z * edge.z};
  }
  int place(IntVec3 at) const {  // within its block, x fastest
    return (at.x & (edge.x - 1)) +
           edge.x * ((at.y & (edge.y - 1)) + edge.y * (at.z & (edge.z - 1)));
  }
};

// An inactive direction has one layer.
inline BlockShape block_shape(const std::array<bool, 3>& active) {
  const int count = active[0] + active[1] + active[2];
  const int shift = count == 3 ? 2 : count == 2 ? 3 : 6;
  BlockShape s;
  for (int d = 0; d < 3; ++d) {
    s.shift[d] = active[d] ? shift : 0;
    s.edge[d] = 1 << s.shift[d];
  }
  return s;
}

}  // namespace sluice
