// Marks of cells near solids: 1 or 0 for each cell of the arrays.
#pragma once
#include <cstdint>
#include <vector>

#include "mpmice/step/solid_fields.hpp"

namespace sluice::mpmice {

using CellMask = std::vector<std::uint8_t>;

// Marks the cells of the domain, too, that lie at most `reach` cells along every direction from a
// marked one, across periodic sides as well.
template <int D>
void dilate(const Frame<D>& frame, int reach, CellMask& mask) {
  CellMask from;
  for (std::size_t d = 0; d < D; ++d) {
    from = mask;
    frame.cells.for_each_cell(frame.domain, [&](const Cell<D>& c, std::size_t i) {
      if (from[i] == 0) return;
      Cell<D> other = c;
      for (other[d] = c[d] - reach; other[d] <= c[d] + reach; ++other[d]) {
        const Cell<D> image = frame.wrapped(other);
        if (!frame.in_domain(image)) continue;
        const std::size_t j = frame.cells.index(image);
        if (j >= CellBlocks<D>::block_cells) mask[j] = 1;
      }
    });
  }
}

}  // namespace sluice::mpmice
