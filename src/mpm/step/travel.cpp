#include "mpm/step/travel.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"

namespace sluice::mpm {

double farthest_way(const ParticleSet& set, const ParticleSet& next, std::size_t at, int n,
                    Vec3 spacing) {
  double far = 0;
  for (int d = 0; d < 3; ++d) {
    const double *x = set.coordinate(d) + at, *to = next.coordinate(d) + at;
    const double inverse = 1 / spacing[d];
    far = largest(0, static_cast<std::size_t>(n), far,
                  [&](auto of) { return magnitude(of(to) - of(x)) * inverse; });
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
    double outside = 0;
    for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
      const auto place = q(x);
      const decltype(place) none{}, one = none + 1.0;
      outside += sum_of_lanes(place >= low ? (place < high ? none : one) : one);
    });
    out |= outside != 0;
  }
  return out;
}

}  // namespace sluice::mpm
