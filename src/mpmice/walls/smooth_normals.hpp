// Directions of surfaces in cells, smoothed over the cells around, which stairs need.
#pragma once
#include "mpmice/surfaces/surface_means.hpp"

namespace sluice::mpmice {

template <int D>
class SmoothNormals {
 public:
  // From the area vectors in wet cells; of cells in which a surface lies.
  void find(const NearCells<D>& near, const SolidGeometry<D>& solid, const OnSurfaces<D>& surface);
  double along(std::size_t d, std::size_t i) const { return n_[d][i]; }
  double length(std::size_t i) const;
  // Cells in a unit of length along it, 1/m; `size`: its length.
  double cells_along(const Frame<D>& frame, std::size_t i, double size) const;
  // The direction of its largest component.
  std::size_t largest(std::size_t i) const;

  static constexpr int columns = D;

 private:
  std::array<Column, D> n_;
};

// The most cells in a unit of length along any direction, 1/m.
template <int D>
double most_cells_in_a_length(const Frame<D>& frame) {
  double cells = 0;
  for (const int d : frame.direction) cells += 1 / frame.spacing[d];
  return cells;
}

}  // namespace sluice::mpmice
