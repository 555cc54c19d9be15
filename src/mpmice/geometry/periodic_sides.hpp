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
};

}  // namespace sluice::mpmice
