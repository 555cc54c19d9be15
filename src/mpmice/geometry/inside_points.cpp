#include "mpmice/geometry/inside_points.hpp"

#include <algorithm>

namespace sluice::mpmice {
namespace {

// In the order of their coordinates.
bool is_before(const double* a, const double* b) {
  return a[0] != b[0] ? a[0] < b[0] : a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

// Twice the area of the triangle a, b, point in the plane of y and z; where that is 0, its sign
// once the point is moved by a little along y, and by less along z.
double turn(const double* a, const double* b, const std::array<double, 3>& point) {
  const double area = (b[1] - a[1]) * (point[2] - a[2]) - (b[2] - a[2]) * (point[1] - a[1]);
  if (area != 0) return area;
  return b[2] != a[2] ? a[2] - b[2] : b[1] - a[1];
}

// 1 or -1 where the ray leaves or enters through a triangle, else 0.
int crossing(const double* const (&v)[3], const std::array<double, 3>& point) {
  int positive = 0;
  for (int k = 0; k < 3; ++k) {
    const double *a = v[k], *b = v[(k + 1) % 3];
    positive += (is_before(a, b) ? turn(a, b, point) : -turn(b, a, point)) > 0 ? 1 : 0;
  }
  if (positive != 0 && positive != 3) return 0;
  const double* w[3] = {v[0], v[1], v[2]};
  std::sort(w, w + 3, is_before);
  std::array<double, 3> e, f;
  for (std::size_t d = 0; d < 3; ++d) {
    e[d] = w[1][d] - w[0][d];
    f[d] = w[2][d] - w[0][d];
  }
  const double nx = e[1] * f[2] - e[2] * f[1], ny = e[2] * f[0] - e[0] * f[2],
               nz = e[0] * f[1] - e[1] * f[0];
  const double x = w[0][0] - (ny * (point[1] - w[0][1]) + nz * (point[2] - w[0][2])) / nx;
  return x > point[0] ? (positive == 3 ? 1 : -1) : 0;
}

int of_face(const ParticleCorners<3>& x, std::size_t face, const std::array<double, 3>& point) {
  std::array<const double*, 4> q;
  for (std::size_t k = 0; k < 4; ++k) q[k] = x[face_corners<3>[face][k]].data();
  const auto beyond = [&](std::size_t d, bool high) {
    bool all = true;
    for (const double* c : q) all = all && (high ? c[d] > point[d] : c[d] < point[d]);
    return all;
  };
  if (beyond(0, false) || beyond(1, false) || beyond(1, true) || beyond(2, false) ||
      beyond(2, true))
    return 0;
  double middle[3];  // as facet_nodes has it
  for (std::size_t d = 0; d < 3; ++d)
    middle[d] = ((q[0][d] + q[2][d]) + (q[1][d] + q[3][d])) * 0.25;
  int sum = 0;
  for (std::size_t t = 0; t < 4; ++t) sum += crossing({middle, q[t], q[(t + 1) % 4]}, point);
  return sum;
}

}  // namespace

template <int D>
int winding_number(const ParticleCorners<D>& x, const std::array<double, D>& point) {
  int sum = 0;
  if constexpr (D == 1) {
    sum = (x[1][0] > point[0] ? 1 : 0) - (x[0][0] > point[0] ? 1 : 0);
  } else if constexpr (D == 2) {
    for (const auto& face : face_corners<2>) {
      const auto &a = x[face[0]], &b = x[face[1]];
      const bool rises = a[1] <= point[1];  // the point moved by a little along y
      if (rises == (b[1] <= point[1])) continue;
      const auto &low = rises ? a : b, &high = rises ? b : a;
      const double along = (point[1] - low[1]) / (high[1] - low[1]);
      if (low[0] + along * (high[0] - low[0]) > point[0]) sum += rises ? 1 : -1;
    }
  } else {
    for (std::size_t face = 0; face < faces_of_particle<3>; ++face) sum += of_face(x, face, point);
  }
  return sum;
}

template int winding_number<1>(const ParticleCorners<1>&, const std::array<double, 1>&);
template int winding_number<2>(const ParticleCorners<2>&, const std::array<double, 2>&);
template int winding_number<3>(const ParticleCorners<3>&, const std::array<double, 3>&);

}  // namespace sluice::mpmice
