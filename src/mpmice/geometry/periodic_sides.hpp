// Periodic sides of a box of cells: what lies beyond one belongs to the image at the other end.
#pragma once
#include "mpmice/geometry/cell_box.hpp"

namespace sluice::mpmice {

template <int D>
struct PeriodicSides {
  CellBox<D> domain;
  std::array<bool, D> periodic{};

  bool any() const {
    for (const bool p : periodic)
      if (p) return true;
    return false;
  }
  // The cell of the domain that one beyond such a side stands for.
  Cell<D> image(Cell<D> c) const {
    for (std::size_t d = 0; d < D; ++d) {
      if (!periodic[d]) continue;
      const int low = domain.lower[d], n = domain.upper[d] - low;
      c[d] = low + ((c[d] - low) % n + n) % n;
    }
    return c;
  }
  // Do cells of a box lie beyond such sides.
  bool any_beyond(const CellBox<D>& box) const {
    for (std::size_t d = 0; d < D; ++d)
      if (periodic[d] && (box.lower[d] < domain.lower[d] || box.upper[d] > domain.upper[d]))
        return true;
    return false;
  }
};

}  // namespace sluice::mpmice
