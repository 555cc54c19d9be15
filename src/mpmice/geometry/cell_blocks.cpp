#include "mpmice/geometry/cell_blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace sluice::mpmice {

template <int D>
void BlockDirectory<D>::begin(const CellBox<D>& cells) {
  for (std::size_t d = 0; d < D; ++d) {
    pages_.lower[d] = cells.lower[d] >> (2 * shift);
    pages_.upper[d] = cells.empty() ? pages_.lower[d] : ((cells.upper[d] - 1) >> (2 * shift)) + 1;
  }
  first_.assign(pages_.cells(), -1);
  entries_.clear();
}

template <int D>
std::int32_t& BlockDirectory<D>::entry(const Cell<D>& block) {
  Cell<D> page;
  bool there = true;
  for (std::size_t d = 0; d < D; ++d) {
    page[d] = block[d] >> shift;
    there &= page[d] >= pages_.lower[d] && page[d] < pages_.upper[d];
  }
  if (!there)
    throw std::out_of_range(
        fmt::format("there is no room for block [{}] of cells", fmt::join(block, " ")));
  std::int32_t& first = first_[pages_.index(page)];
  if (first < 0) {
    first = static_cast<std::int32_t>(entries_.size());
    entries_.resize(entries_.size() + 64, 0);
  }
  return entries_[static_cast<std::size_t>(first) + place_of(block)];
}

template <int D>
void CellBlocks<D>::begin(const CellBox<D>& room) {
  room_ = room;
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

template class BlockDirectory<1>;
template class BlockDirectory<2>;
template class BlockDirectory<3>;
template class CellBlocks<1>;
template class CellBlocks<2>;
template class CellBlocks<3>;

}  // namespace sluice::mpmice
