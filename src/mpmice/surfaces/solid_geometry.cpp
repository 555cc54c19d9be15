#include "mpmice/surfaces/solid_geometry.hpp"

namespace sluice::mpmice {

template <int D>
void keep_pockets(const NearCells<D>& near, SolidGeometry<D>& solid) {
  constexpr double least_pocket = 1e-3;  // of a cell
  KeptArray<std::size_t> pockets;
  near.for_each([&](const Cell<D>& c, std::size_t i) {
    if (!solid.wet(i) || solid.theta_next[i] < 1) return;
    bool taken = false;
    near.for_each_neighbour(c, [&](std::size_t j) { taken |= solid.theta_next[j] < 1 - 1e-8; });
    if (!taken) pockets.push_back(i);
  });
  for (const std::size_t i : pockets)
    solid.theta_next[i] = 1 - std::min(least_pocket, 1 - solid.theta[i]);
}

template <int D>
void close_cells_at_sides(const NearCells<D>& near, SolidGeometry<D>& solid) {
  const Frame<D>& frame = near.frame();
  const auto whole = [&](std::size_t d, std::size_t face) {
    return solid.covered[d][face] >= 1 && solid.covered_next[d][face] >= 1 &&
           solid.mean_covered[d][face] >= 1;
  };
  KeptArray<Cell<D>> closed;
  near.for_each([&](const Cell<D>& c, std::size_t i) {
    if (solid.theta[i] < 1 || solid.theta_next[i] < 1) return;
    for (std::size_t d = 0; d < D; ++d) {
      if (frame.periodic[d]) continue;
      Cell<D> above = c;
      ++above[d];
      if ((c[d] == frame.domain.lower[d] && whole(d, i)) ||
          (above[d] == frame.domain.upper[d] && whole(d, frame.cells.index(above))))
        closed.push_back(c);
    }
  });
  for (const Cell<D>& c : closed)
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      ++above[d];
      for (const std::size_t face : {frame.cells.index(c), frame.cells.index(above)})
        for (auto* covered : {&solid.covered, &solid.covered_next, &solid.mean_covered})
          (*covered)[d][face] = 1;
    }
}

template void keep_pockets(const NearCells<1>&, SolidGeometry<1>&);
template void keep_pockets(const NearCells<2>&, SolidGeometry<2>&);
template void keep_pockets(const NearCells<3>&, SolidGeometry<3>&);
template void close_cells_at_sides(const NearCells<1>&, SolidGeometry<1>&);
template void close_cells_at_sides(const NearCells<2>&, SolidGeometry<2>&);
template void close_cells_at_sides(const NearCells<3>&, SolidGeometry<3>&);

}  // namespace sluice::mpmice
