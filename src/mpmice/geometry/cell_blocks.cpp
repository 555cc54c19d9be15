#include "mpmice/geometry/cell_blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace sluice::mpmice {

template <int D>
void CellBlocks<D>::begin(const CellBox<D>& room, const BlockSharers<D>* sharers) {
  room_ = room;
  sharers_ = sharers;
  directory_.begin(room);
  blocks_.clear();
  above_.clear();
  slabs_.clear();
  columns_.clear();
}

template <int D>
void CellBlocks<D>::add(const CellBox<D>& cells) {
  const CellBox<D> inside = common<D>(cells, room_);
  for_each_cell_of<D>(Directory::blocks_of(inside), [&](const Cell<D>& b) {
    if (sharers_ != nullptr && !sharers_->has(b)) return;
    std::int32_t& entry = directory_.entry(b);
    if (entry != 0) return;
    blocks_.push_back(b);
    entry = 1;
  });
}

template <int D>
void CellBlocks<D>::finish() {
  const auto differ = [&](std::size_t n, std::size_t along) {  // from the block before
    for (std::size_t d = along; d < D; ++d)
      if (blocks_[n][d] != blocks_[n - 1][d]) return true;
    return false;
  };
  std::sort(blocks_.begin(), blocks_.end(), [](const Cell<D>& a, const Cell<D>& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  });
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    directory_.entry(blocks_[n]) = static_cast<std::int32_t>(n + 1);
    if (n == 0 || differ(n, 1)) columns_.push_back(static_cast<std::uint32_t>(n));
    if (n == 0 || (D > 2 ? differ(n, 2) : D == 1)) slabs_.push_back(static_cast<std::uint32_t>(n));
  }
  for (auto* ends : {&slabs_, &columns_})
    ends->push_back(static_cast<std::uint32_t>(blocks_.size()));
  above_.resize(blocks_.size() * D);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = blocks_[n];
      ++above[d];
      above_[n * D + d] = directory_.find(above);
    }
  list_shared();
}

template <int D>
void CellBlocks<D>::list_shared() {
  shared_.resize(sharers_ == nullptr ? 0 : sharers_->neighbour_count());
  for (auto& of : shared_) of.clear();
  for (std::size_t n = 0; n < blocks_.size() && !shared_.empty(); ++n)
    for (const int neighbour : sharers_->others(blocks_[n]))
      shared_[static_cast<std::size_t>(neighbour)].push_back(static_cast<std::uint32_t>(n + 1));
}

template <int D>
CellBlocks<D> CellBlocks<D>::around(const CellBox<D>& cells) {
  CellBlocks blocks;
  blocks.begin(cells);
  blocks.add(cells);
  blocks.finish();
  return blocks;
}

template <int D>
void CellBlocks<D>::refuse(const Cell<D>& c) {
  throw std::out_of_range(fmt::format(
      "a solid reaches cell [{}], which is not among those near solids", fmt::join(c, " ")));
}

template class CellBlocks<1>;
template class CellBlocks<2>;
template class CellBlocks<3>;

}  // namespace sluice::mpmice
