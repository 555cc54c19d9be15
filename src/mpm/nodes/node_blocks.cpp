#include "mpm/nodes/node_blocks.hpp"

#include <algorithm>

namespace sluice::mpm {

void BlockTable::clear() {
  blocks_.clear();
  if (table_.empty()) table_.resize(256);
  std::fill(table_.begin(), table_.end(), -1);
}

std::size_t BlockTable::home(IntVec3 b) const {
  std::uint64_t h = static_cast<std::uint32_t>(b.x) * 0x9e3779b97f4a7c15ULL;
  h ^= static_cast<std::uint32_t>(b.y) * 0xc2b2ae3d27d4eb4fULL;
  h ^= static_cast<std::uint32_t>(b.z) * 0x165667b19e3779f9ULL;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9ULL;
  return (h >> 32) & (table_.size() - 1);
}

int BlockTable::find(IntVec3 b) const {
  for (std::size_t at = home(b);; at = (at + 1) & (table_.size() - 1)) {
    const std::int32_t n = table_[at];
    if (n < 0) return -1;
    if (blocks_[n] == b) return n;
  }
}

int BlockTable::find_or_add(IntVec3 b) {
  const int found = find(b);
  if (found >= 0) return found;
  if (2 * (blocks_.size() + 1) > table_.size()) grow();
  std::size_t at = home(b);
  while (table_[at] >= 0) at = (at + 1) & (table_.size() - 1);
  table_[at] = count();
  blocks_.push_back(b);
  return count() - 1;
}

void BlockTable::grow() {
  table_.assign(2 * table_.size(), -1);
  for (int n = 0; n < count(); ++n) {
    std::size_t at = home(block(n));
    while (table_[at] >= 0) at = (at + 1) & (table_.size() - 1);
    table_[at] = n;
  }
}

}  // namespace sluice::mpm
