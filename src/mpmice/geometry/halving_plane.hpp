// The plane that halves a cell, across a given normal.
//
// Its area is the cell's volume times the density at 0 of sum_d n_d h_d x_d with x_d spread evenly
// over -1/2 ... 1/2 (h_d: edges of the cell, n: unit normal). The inverse of that density is the
// width across the normal of a slab with the plane's area and the cell's volume: the edge along n
// of a cell that n is parallel to.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace sluice::mpmice {

// V/A, m. `unit`: n; `edge`: h_d, m.
template <std::size_t D>
double width_across(const std::array<double, D>& unit, const std::array<double, D>& edge) {
  std::array<double, 3> w{};
  for (std::size_t d = 0; d < D; ++d) w[d] = std::fabs(unit[d] * edge[d]);
  std::sort(w.begin(), w.end());
  const auto [c, b, a] = w;
  if (a >= b + c) return a;
  // All three: the plane is a hexagon.
  return 4 * a * b * c / (2 * (a * b + b * c + c * a) - a * a - b * b - c * c);
}

}  // namespace sluice::mpmice
