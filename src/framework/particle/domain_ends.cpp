// One side at a time, until the point is inside or gone.
#include "framework/particle/domain_ends.hpp"

#include <cmath>

#include "framework/particle/particle_map.hpp"

namespace sluice {
namespace {

// A mirrored or wrapped point may round to the upper end, whose cell is outside.
double below(double upper, double lower, double x) {
  return x < upper ? x : std::nextafter(upper, lower);
}

}  // namespace

bool bring_inside(const Level& level, const Reflects& reflects, Vec3& point) {
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const double low = level.anchor[d] + level.domain.lower[d] * level.spacing[d];
    const double high = level.anchor[d] + level.domain.upper[d] * level.spacing[d];
    double& x = point[d];
    for (;;) {
      const int cell = cell_at(level, point)[d];
      const bool under = cell < level.domain.lower[d], over = cell >= level.domain.upper[d];
      if (!under && !over) break;
      if (level.periodic[d]) {
        x = under ? below(high, low, x + (high - low)) : std::fmax(low, x - (high - low));
      } else if (reflects(side_of(d, over), cell_at(level, point))) {
        x = under ? std::fmax(low, 2 * low - x) : below(high, low, 2 * high - x);
      } else {
        return false;
      }
    }
  }
  return true;
}

}  // namespace sluice
