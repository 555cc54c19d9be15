// Which block of cells lies where: a number for each block of 64 cells (4^3, 8^2 or 64).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpmice/geometry/cell_box.hpp"

namespace sluice::mpmice {

// A sparse array over blocks of cells: pages of 64 blocks, of which only those exist that hold any.
template <int D>
class BlockDirectory {
 public:
  static constexpr int shift = D == 3 ? 2 : D == 2 ? 3 : 6;  // edge of a block: 2^shift cells
  static constexpr int edge = 1 << shift;

  static Cell<D> block_of(const Cell<D>& c) {
    Cell<D> b;
    for (std::size_t d = 0; d < D; ++d) b[d] = c[d] >> shift;
    return b;
  }
  // The blocks that a box of cells meets.
  static CellBox<D> blocks_of(const CellBox<D>& cells) {
    if (cells.empty()) return {};
    CellBox<D> to{block_of(cells.lower), {}};
    for (std::size_t d = 0; d < D; ++d) to.upper[d] = ((cells.upper[d] - 1) >> shift) + 1;
    return to;
  }
  static CellBox<D> cells_of(const Cell<D>& block) {
    CellBox<D> to;
    for (std::size_t d = 0; d < D; ++d) {
      to.lower[d] = block[d] * edge;
      to.upper[d] = to.lower[d] + edge;
    }
    return to;
  }
  // Of a cell in its block, x fastest.
  static std::size_t place_of(const Cell<D>& c) {
    std::size_t at = 0;
    for (std::size_t d = D; d-- > 0;)
      at = (at << shift) + static_cast<std::size_t>(c[d] & (edge - 1));
    return at;
  }
  // No entry, and room for the blocks around these cells. Keeps its memory.
  void begin(const CellBox<D>& cells);
  // Entry of a block; 0: it has none, or there is no room for one.
  std::int32_t find(const Cell<D>& block) const {
    std::ptrdiff_t page = 0;
    for (std::size_t d = D; d-- > 0;) {
      const int at = (block[d] >> shift) - pages_.lower[d];
      if (at < 0 || at >= pages_.size(static_cast<int>(d))) return 0;
      page = page * pages_.size(static_cast<int>(d)) + at;
    }
    const std::int32_t first = first_[static_cast<std::size_t>(page)];
    return first < 0 ? 0 : entries_[static_cast<std::size_t>(first) + place_of(block)];
  }
  // act(entry) for all entries that are not 0, in any order.
  template <class Act>
  void for_each_entry(Act&& act) {
    for (std::int32_t& entry : entries_)
      if (entry != 0) act(entry);
  }
  // Its entry, to be changed. Throws std::out_of_range where there is no room.
  std::int32_t& entry(const Cell<D>& block);

 private:
  CellBox<D> pages_;
  std::vector<std::int32_t> first_;    // of the entries of a page; -1: it has none
  std::vector<std::int32_t> entries_;  // 64 a page
};

}  // namespace sluice::mpmice
