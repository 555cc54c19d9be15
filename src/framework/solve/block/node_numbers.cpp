#include "framework/solve/block/node_numbers.hpp"

namespace sluice::solve {

NodeNumbers::NodeNumbers(IntVec3 lower, IntVec3 upper) : lower_(lower), size_(upper - lower) {
  std::size_t tiles = 1;
  for (int d = 0; d < 3; ++d) {
    shift_[d] = size_[d] >= 8 ? 3 : 0;
    count_[d] = (size_[d] + (1 << shift_[d]) - 1) >> shift_[d];
    tiles *= static_cast<std::size_t>(count_[d]);
  }
  tiles_.assign(tiles, -1);
}

void NodeNumbers::mark(IntVec3 node) {
  const IntVec3 i = node - lower_;
  std::int32_t& tile = tiles_[tile_of(i)];
  if (tile < 0) {
    const std::size_t size = std::size_t{1} << (shift_.x + shift_.y + shift_.z);
    tile = static_cast<std::int32_t>(numbers_.size() / size);
    numbers_.resize(numbers_.size() + size, -1);
  }
  numbers_[at(tile, i)] = 0;
}

std::vector<IntVec3> NodeNumbers::number() {
  std::vector<IntVec3> nodes;
  IntVec3 i;
  for (i.z = 0; i.z < size_.z; ++i.z)
    for (i.y = 0; i.y < size_.y; ++i.y)
      for (int column = 0; column < count_.x; ++column) {
        i.x = column << shift_.x;
        const std::int32_t tile = tiles_[tile_of(i)];
        if (tile < 0) continue;
        for (; i.x < size_.x && i.x >> shift_.x == column; ++i.x) {
          std::int32_t& number = numbers_[at(tile, i)];
          if (number < 0) continue;
          number = static_cast<std::int32_t>(nodes.size());
          nodes.push_back(lower_ + i);
        }
      }
  return nodes;
}

}  // namespace sluice::solve
