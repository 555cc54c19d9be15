#include "mpm/loads/corner_loads.hpp"

#include <cmath>

namespace sluice::mpm {
namespace {

double length(Vec3 v) {
  return std::sqrt(dot(v, v));
}

}  // namespace

std::array<CornerForce, 4> corner_forces(Vec3 x, Vec3 force, Vec3 n,
                                         const std::array<Vec3, 3>& edges,
                                         const std::array<Vec3, 3>& rest) {
  std::size_t along = 0;
  double best = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double cosine = std::fabs(dot(edges[k], n)) / length(edges[k]);
    if (cosine > best) {
      best = cosine;
      along = k;
    }
  }
  const std::size_t a = (along + 1) % 3, b = (along + 2) % 3;
  const Vec3 centre = x + (dot(edges[along], n) < 0 ? -0.5 : 0.5) * edges[along];
  const double growth = length(cross(edges[a], edges[b])) / length(cross(rest[a], rest[b]));
  std::array<CornerForce, 4> corners;
  for (std::size_t c = 0; c < 4; ++c)
    corners[c] = {
        centre + (c % 2 == 0 ? -0.5 : 0.5) * edges[a] + (c / 2 == 0 ? -0.5 : 0.5) * edges[b],
        (0.25 * growth) * force};
  return corners;
}

}  // namespace sluice::mpm
