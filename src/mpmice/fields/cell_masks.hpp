// Marks of cells near solids: 1 or 0 for each cell of the arrays.
#pragma once
#include <cstdint>
#include <vector>

#include "mpmice/fields/frame.hpp"

namespace sluice::mpmice {

using CellMask = KeptArray<std::uint8_t>;

// Marks the cells, too, that lie at most `reach` cells along every direction from a marked one.
// Around periodic sides the frame says which; elsewhere cells beyond the sides may be marked.
template <int D>
class Dilation {
 public:
  explicit Dilation(const Frame<D>& frame) : frame_(frame) {}
  void operator()(int reach, CellMask& mask) {
    for (int d = 0; d < D; ++d) {
      if (frame_.periodic[static_cast<std::size_t>(d)])
        by_cells(reach, d, mask);
      else
        by_blocks(reach, d, mask);
    }
  }

 private:
  using Blocks = CellBlocks<D>;
  // A block has 64 cells: its marks are the bits of a number.
  void by_blocks(int reach, int d, CellMask& mask) {
    const Blocks& cells = frame_.cells;
    constexpr std::size_t n = Blocks::block_cells;
    const std::size_t step = Blocks::stride(d);
    std::uint64_t lowest = 0;  // cells of the lowest layer along d
    for (std::size_t i = 0; i < n; ++i)
      if (i / step % Blocks::edge == 0) lowest |= std::uint64_t{1} << i;
    const std::uint64_t highest = lowest << ((Blocks::edge - 1) * step);
    bits_.assign(1 + cells.block_count(), 0);
    for (std::size_t b = 1; b < bits_.size(); ++b)
      for (std::size_t i = 0; i < n; ++i) bits_[b] |= std::uint64_t{mask[b * n + i] != 0} << i;
    for (int k = 0; k < reach; ++k) {
      before_ = bits_;
      for (std::size_t b = 1; b < bits_.size(); ++b) {
        const std::uint64_t own = before_[b];
        bits_[b] |= (own & ~highest) << step | (own & ~lowest) >> step;
        const std::size_t above = cells.above(b, d);
        if (above == 0) continue;
        bits_[above] |= (own & highest) >> ((Blocks::edge - 1) * step);
        bits_[b] |= (before_[above] & lowest) << ((Blocks::edge - 1) * step);
      }
    }
    for (std::size_t b = 1; b < bits_.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        mask[b * n + i] = static_cast<std::uint8_t>(bits_[b] >> i & 1);
  }
  void by_cells(int reach, int d, CellMask& mask) {
    const auto a = static_cast<std::size_t>(d);
    const CellMask from = mask;
    frame_.cells.for_each_cell(frame_.domain, [&](const Cell<D>& c, std::size_t i) {
      if (from[i] == 0) return;
      Cell<D> other = c;
      for (other[a] = c[a] - reach; other[a] <= c[a] + reach; ++other[a]) {
        const std::size_t j = frame_.cells.index(frame_.wrapped(other));
        if (j >= Blocks::block_cells) mask[j] = 1;
      }
    });
  }

  const Frame<D>& frame_;
  KeptArray<std::uint64_t> bits_, before_;  // by block; the first of them is none
};

template <int D>
void dilate(const Frame<D>& frame, int reach, CellMask& mask) {
  Dilation<D> dilation(frame);
  dilation(reach, mask);
}

}  // namespace sluice::mpmice
