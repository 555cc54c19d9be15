// Blocks of 64 cells (4^3, 8^2 or 64) near solids, and where their cells lie in arrays over them.
//
// Empty space between bodies has no blocks: what is kept of cells grows with the solids and their
// surfaces, not with a box around them. Arrays have size() numbers. The first 64 of them belong to
// no block: all cells without one read there what the array holds far from solids, and nobody may
// write there. Blocks are numbered in the order of their cells, x fastest, z slowest, so that the
// one above along any direction has the higher number.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpmice/geometry/block_sharers.hpp"

namespace sluice::mpmice {

template <int D>
class CellBlocks {
 public:
  using Directory = BlockDirectory<D>;
  static constexpr int edge = Directory::edge;
  static constexpr std::size_t block_cells = 64;

  // No blocks, and room for those around these cells. Keeps its memory, and a pointer to who shares
  // them (null: this is the only rank).
  void begin(const CellBox<D>& room, const BlockSharers<D>* sharers = nullptr);
  // Adds the blocks in which cells lie; those beyond the room, or that this rank has not, are left
  // out.
  void add(const CellBox<D>& cells);
  // Once all are added: numbers them.
  void finish();
  // All blocks around a box of cells.
  static CellBlocks around(const CellBox<D>& cells);

  // Null: this is the only rank. Then, by neighbour, the numbers of the blocks that are shared with
  // it, in an order that is the same there.
  const BlockSharers<D>* sharers() const { return sharers_; }
  const std::vector<std::vector<std::uint32_t>>& shared() const { return shared_; }

  // Of arrays over the cells of all blocks, and of none.
  std::size_t size() const { return (1 + blocks_.size()) * block_cells; }
  std::size_t block_count() const { return blocks_.size(); }
  // Where a cell lies in arrays: among the first 64 where it has no block.
  std::size_t index(const Cell<D>& c) const {
    return static_cast<std::size_t>(directory_.find(Directory::block_of(c))) * block_cells +
           Directory::place_of(c);
  }
  bool holds(const Cell<D>& c) const { return directory_.find(Directory::block_of(c)) != 0; }
  // The same of a cell that something is added to: std::out_of_range where it has no block.
  std::size_t index_to_add(const Cell<D>& c) const {
    const std::size_t i = index(c);
    if (i < block_cells) refuse(c);
    return i;
  }
  // Cells of block n, 1 to block_count().
  CellBox<D> cells(std::size_t n) const { return Directory::cells_of(blocks_[n - 1]); }
  // The block above block n along d; 0: there is none.
  std::size_t above(std::size_t n, int d) const {
    return static_cast<std::size_t>(above_[(n - 1) * D + static_cast<std::size_t>(d)]);
  }
  // Distance in arrays of cells of one block that lie beside each other along d.
  static constexpr std::size_t stride(int d) { return std::size_t{1} << (Directory::shift * d); }
  // Where the cell above along d lies, of one at `i` that has a block.
  std::size_t cell_above(std::size_t i, int d) const {
    const std::size_t step = stride(d), last = (edge - 1) * step;
    if ((i & last) != last) return i + step;
    return above(i / block_cells, d) * block_cells + (i % block_cells & ~last);
  }

  // act(cell, where it lies) for the cells of all blocks that lie in `part`, x fastest, z slowest:
  // what is rounded in this order does not depend on blocks.
  template <class Act>
  void for_each_cell(const CellBox<D>& part, Act&& act) const {
    for_each_row([&](Cell<D> c, std::size_t i) {
      for (std::size_t d = 1; d < D; ++d)
        if (c[d] < part.lower[d] || c[d] >= part.upper[d]) return;
      const int begin = std::max(c[0], part.lower[0]), end = std::min(c[0] + edge, part.upper[0]);
      i += static_cast<std::size_t>(begin - c[0]);
      for (c[0] = begin; c[0] < end; ++c[0], ++i) act(static_cast<const Cell<D>&>(c), i);
    });
  }
  // The same for the cells of block n that lie in `part`.
  template <class Act>
  void for_each_cell_of_block(std::size_t n, const CellBox<D>& part, Act&& act) const {
    const CellBox<D> all = cells(n), inside = common<D>(all, part);
    for_each_cell_of<D>(inside, [&](const Cell<D>& c) {
      std::size_t i = n * block_cells;
      for (std::size_t d = 0; d < D; ++d)
        i += static_cast<std::size_t>(c[d] - all.lower[d]) * stride(static_cast<int>(d));
      act(c, i);
    });
  }
  // act(its cells in the box) for the blocks that meet a box.
  template <class Act>
  void for_each_part(const CellBox<D>& box, Act&& act) const;
  // Has any cell of a box a block.
  bool holds_any(const CellBox<D>& box) const {
    return any_block(box, [](std::size_t) { return true; });
  }
  // Is act(n) true for any of the blocks that meet a box; the first ends the search.
  template <class Act>
  bool any_block(const CellBox<D>& box, Act&& act) const {
    return any_cell_of<D>(Directory::blocks_of(box), [&](const Cell<D>& b) {
      const std::int32_t n = directory_.find(b);
      return n != 0 && act(static_cast<std::size_t>(n));
    });
  }

 private:
  // act(first cell, where it lies) for each row of a block along x, in the order of cells.
  template <class Act>
  void for_each_row(Act&& act) const;
  void list_shared();
  [[noreturn]] static void refuse(const Cell<D>& c);

  CellBox<D> room_;
  const BlockSharers<D>* sharers_ = nullptr;
  std::vector<std::vector<std::uint32_t>> shared_;
  Directory directory_;  // numbers of blocks
  std::vector<Cell<D>> blocks_;
  std::vector<std::int32_t> above_;  // [block][direction]
  // Where blocks begin that share the coordinate along z, and those along y and z; the first block
  // is 0 here.
  KeptArray<std::uint32_t> slabs_, columns_;
};

template <int D>
template <class Act>
void CellBlocks<D>::for_each_row(Act&& act) const {
  const auto row = [&](std::size_t n, std::size_t j, std::size_t k) {
    Cell<D> c;
    for (std::size_t d = 0; d < D; ++d) c[d] = blocks_[n][d] * edge;
    if constexpr (D > 1) c[1] += static_cast<int>(j);
    if constexpr (D > 2) c[2] += static_cast<int>(k);
    act(c, (n + 1) * block_cells + (j + k * edge) * edge);
  };
  if constexpr (D == 1) {
    for (std::size_t n = 0; n < blocks_.size(); ++n) row(n, 0, 0);
  } else {
    std::size_t column = 0;
    for (std::size_t s = 0; s + 1 < slabs_.size(); ++s) {
      const std::size_t first = column;
      for (std::size_t k = 0; k < (D > 2 ? edge : 1); ++k)
        for (column = first; columns_[column] < slabs_[s + 1]; ++column)
          for (std::size_t j = 0; j < edge; ++j)
            for (std::size_t n = columns_[column]; n < columns_[column + 1]; ++n) row(n, j, k);
    }
  }
}

template <int D>
template <class Act>
void CellBlocks<D>::for_each_part(const CellBox<D>& box, Act&& act) const {
  any_block(box, [&](std::size_t n) {
    act(common<D>(cells(n), box));
    return false;
  });
}

}  // namespace sluice::mpmice
