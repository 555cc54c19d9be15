#include "mpm/step/travel.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/step/largest.hpp"

namespace sluice::mpm {

double farthest_way(const ParticleSet& set, const ParticleSet& next, std::size_t at, int n,
                    Vec3 spacing) {
  double far = 0;
  for (int d = 0; d < 3; ++d) {
    const double *x = set.coordinate(d) + at, *to = next.coordinate(d) + at;
    const double inverse = 1 / spacing[d];
    far = largest(0, static_cast<std::size_t>(n), far,
                  [&](std::size_t q) { return std::fabs(to[q] - x[q]) * inverse; });
  }
  return far;
}

bool any_outside(const Level& level, const ParticleSet& next, std::size_t at, int n) {
  bool out = false;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[static_cast<std::size_t>(d)]) continue;
    const double low = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
    const double high = level.anchor[d] + level.domain.upper[d] * level.spacing[d];
    const double* x = next.coordinate(d) + at;
    // Written so that what is no number counts as outside.
    for (int q = 0; q < n; ++q) out |= !(x[q] >= low && x[q] < high);
  }
  return out;
}

}  // namespace sluice::mpm
