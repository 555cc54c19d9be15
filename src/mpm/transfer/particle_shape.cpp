#include "mpm/transfer/particle_shape.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

constexpr double min_half = 1.0 / 256, max_half = 0.5;  // cells

}  // namespace

void own_widths(Basis basis, const TransferGrid& grid, const ParticleShape& shape, int d, int at,
                int n, double* to) {
  const double* half = shape.half[d];
  if (half != nullptr)
    std::copy_n(half + at, n, to);
  else
    std::fill_n(to, n, grid.half[d]);
  if (basis == Basis::cpgimp) {
    const double* stretch = shape.F[4 * d] + at;
    for (int q = 0; q < n; ++q) to[q] *= std::fabs(stretch[q]);
  }
  for (int q = 0; q < n; ++q) to[q] = std::min(max_half, std::max(min_half, to[q]));
}

}  // namespace sluice::mpm
