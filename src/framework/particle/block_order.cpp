#include "framework/particle/block_order.hpp"

#include <algorithm>
#include <numeric>

#include "framework/particle/particle_map.hpp"

namespace sluice {
namespace {

// The blocks between two corners, numbered.
struct BlockNumbers {
  IntVec3 low, size;

  std::size_t count() const { return static_cast<std::size_t>(size.x) * size.y * size.z; }
  std::size_t operator()(IntVec3 b) const {
    return b.x - low.x + size.x * (b.y - low.y + static_cast<std::size_t>(size.y) * (b.z - low.z));
  }
};

}  // namespace

std::vector<BlockRun> sort_by_blocks(ParticleSet& set, const Level& level) {
  if (set.empty()) return {};
  const BlockShape shape = block_shape(level.active);
  const auto block_of = [&](std::size_t n) {
    return shape.block_of(cell_at(level, set.position(n)));
  };
  BlockNumbers number{block_of(0), {}};
  IntVec3 high = number.low;
  for (std::size_t n = 0; n < set.size(); ++n) {  // found twice: kept, they would be 12 bytes each
    const IntVec3 b = block_of(n);
    number.low = min(number.low, b);
    high = max(high, b);
  }
  number.size = high - number.low + IntVec3{1, 1, 1};
  std::vector<std::uint32_t> first(number.count() + 1, 0), at(set.size());
  bool sorted = true;
  for (std::size_t n = 0; n < set.size(); ++n) {
    at[n] = static_cast<std::uint32_t>(number(block_of(n)));
    ++first[at[n] + 1];
    sorted = sorted && (n == 0 || at[n - 1] <= at[n]);
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<BlockRun> runs;
  std::size_t block = 0;
  for (int z = 0; z < number.size.z; ++z)
    for (int y = 0; y < number.size.y; ++y)
      for (int x = 0; x < number.size.x; ++x, ++block)
        if (first[block + 1] > first[block])
          runs.push_back({number.low + IntVec3{x, y, z}, first[block], first[block + 1]});
  if (sorted) return runs;
  std::vector<std::uint32_t> order(set.size());
  for (std::uint32_t n = 0; n < set.size(); ++n) order[first[at[n]]++] = n;
  set.select(order);
  return runs;
}

}  // namespace sluice
