#include "mpm/contact/surface_table.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {

// The weight of a particle at u cells from the node (uGIMP).
static double weight(double u, double l) {
  const double r = std::fabs(u);
  if (r < l) return 1 - (r * r + l * l) / (2 * l);
  if (r < 1 - l) return 1 - r;
  if (r < 1 + l) return (1 + l - r) * (1 + l - r) / (4 * l);
  return 0;
}

SurfaceTable::SurfaceTable(double half) : reach_(1 + half) {
  // From the upper end down, by the midpoint rule on parts of each interval.
  constexpr int parts = 16;
  const double du = 2 * reach_ / intervals / parts;
  double sum = 0, moment = 0;
  mean_[intervals] = reach_;
  for (int n = intervals - 1; n >= 0; --n) {
    const double low = -reach_ + 2 * reach_ * n / intervals;
    for (int p = parts - 1; p >= 0; --p) {
      const double u = low + (p + 0.5) * du, w = weight(u, half);
      sum += w;
      moment += w * u;
    }
    mean_[n] = sum > 0 ? moment / sum : low;
  }
}

double SurfaceTable::surface(double mean) const {
  const auto above = std::upper_bound(mean_.begin(), mean_.end(), mean);
  if (above == mean_.begin()) return -reach_;
  if (above == mean_.end()) return reach_;
  const auto n = above - mean_.begin() - 1;
  const double share = (mean - above[-1]) / (above[0] - above[-1]);
  return -reach_ + 2 * reach_ * (static_cast<double>(n) + share) / intervals;
}

}  // namespace sluice::mpm
