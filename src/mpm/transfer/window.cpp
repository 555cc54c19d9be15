#include "mpm/transfer/window.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

Window::Window(const BlockShape& shape, int reach) : shape_(shape), reach_(reach) {}

void Window::begin(IntVec3 block) {
  IntVec3 lowest = shape_.lower(block), highest = lowest;
  for (int d = 0; d < 3; ++d)
    if (shape_.edge[d] > 1) {
      lowest[d] -= reach_;
      highest[d] += shape_.edge[d] + reach_;
    }
  begin(lowest, highest);
}

void Window::begin(IntVec3 lowest, IntVec3 highest) {
  move_to(lowest, highest);
  std::fill(lanes_.begin(), lanes_.end(), 0);
}

void Window::move_to(IntVec3 lowest, IntVec3 highest) {
  lower_ = lowest;
  size_ = highest - lowest + IntVec3{1, 1, 1};
  lanes_.resize(static_cast<std::size_t>(size_.x) * size_.y * size_.z * lanes);
}

// act(block number, row within the block, row within the window, nodes of the row); the number of
// a block that the table lacks is -1.
template <class Act>
void Window::for_each_part(const BlockTable& table, Act&& act) const {
  const IntVec3 last{lower_.x + size_.x - 1, lower_.y + size_.y - 1, lower_.z + size_.z - 1};
  const IntVec3 first_block = shape_.block_of(lower_), last_block = shape_.block_of(last);
  for (int bz = first_block.z; bz <= last_block.z; ++bz)
    for (int by = first_block.y; by <= last_block.y; ++by)
      for (int bx = first_block.x; bx <= last_block.x; ++bx) {
        const int n = table.find({bx, by, bz});
        const IntVec3 low = shape_.lower({bx, by, bz});
        const IntVec3 from = max(low, lower_);
        const IntVec3 to = min(low + shape_.edge, last + IntVec3{1, 1, 1});
        for (int k = from.z; k < to.z; ++k)
          for (int j = from.y; j < to.y; ++j) {
            const std::ptrdiff_t own =
                (from.x - lower_.x) +
                static_cast<std::ptrdiff_t>(size_.x) *
                    ((j - lower_.y) + static_cast<std::ptrdiff_t>(size_.y) * (k - lower_.z));
            act(n, shape_.place({from.x, j, k}), own, to.x - from.x);
          }
      }
}

void Window::load(IntVec3 block, const BlockTable& table, const NodeLanes& from) {
  begin(block);
  take(table, from);
}

void Window::load(IntVec3 lowest, IntVec3 highest, const BlockTable& table, const NodeLanes& from) {
  move_to(lowest, highest);
  take(table, from);
}

void Window::take(const BlockTable& table, const NodeLanes& from) {
  for_each_part(table, [&](int n, int row, std::ptrdiff_t own, int count) {
    const std::size_t size = static_cast<std::size_t>(count) * lanes;
    std::int64_t* to = lanes_.data() + own * lanes;
    if (n < 0)
      std::fill_n(to, size, 0);
    else
      std::memcpy(to, from.sums(n) + row * lanes, size * sizeof(std::int64_t));
  });
}

void Window::add_to(const BlockTable& table, NodeLanes& to, bool shared) const {
  for_each_part(table, [&](int n, int row, std::ptrdiff_t own, int count) {
    if (n < 0) return;
    const std::int64_t* from = lanes_.data() + own * lanes;
    std::int64_t* sums = to.sums(n) + row * lanes;
    for (int i = 0; i < count; ++i, from += lanes, sums += lanes) {
      if (from[count_lane] == 0) continue;
      if (shared)
        for (int l = 0; l < lanes; ++l)
          std::atomic_ref(sums[l]).fetch_add(from[l], std::memory_order_relaxed);
      else
        for (int l = 0; l < lanes; ++l) sums[l] = wrapped_sum(sums[l], from[l]);
    }
  });
}

bool Window::any_in(int lane) const {
  for (std::size_t l = static_cast<std::size_t>(lane); l < lanes_.size(); l += lanes)
    if (lanes_[l] != 0) return true;
  return false;
}

void add_blocks(BlockTable& table, IntVec3 lowest, IntVec3 highest) {
  const IntVec3 first = table.shape().block_of(lowest), last = table.shape().block_of(highest);
  for (int bz = first.z; bz <= last.z; ++bz)
    for (int by = first.y; by <= last.y; ++by)
      for (int bx = first.x; bx <= last.x; ++bx) table.find_or_add({bx, by, bz});
}

}  // namespace sluice::mpm
