// Pieces with curved faces: sphere, ellipsoid, cylinder, cone, torus.
#include "framework/geometry/round.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"

namespace sluice {

namespace {

void require_positive(const char* piece, const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("{}: {} is {}; it must be greater than 0", piece, what, value));
}

}  // namespace

SpherePiece::SpherePiece(Vec3 origin, double radius) : origin_(origin), radius_(radius) {
  require_positive("sphere", "radius", radius);
}

EllipsoidPiece::EllipsoidPiece(Vec3 origin, Vec3 v1, Vec3 v2, Vec3 v3) : origin_(origin) {
  const std::array<Vec3, 3> v = {v1, v2, v3};
  Vec3 reach{};
  for (std::size_t i = 0; i < 3; ++i) {
    require_positive("ellipsoid", "length of a half axis", std::sqrt(dot(v[i], v[i])));
    const double off = dot(v[i], v[(i + 1) % 3]);
    if (std::abs(off) >= 1e-12)
      throw InputError(
          fmt::format("ellipsoid: v{} . v{} is {}; the half axes must be orthogonal (below 1e-12)",
                      i + 1, (i + 1) % 3 + 1, off));
    axes_[i] = (1 / dot(v[i], v[i])) * v[i];
    reach += v[i] * v[i];
  }
  for (int d = 0; d < 3; ++d) reach[d] = std::sqrt(reach[d]);
  bounds_ = with_margin({origin - reach, origin + reach});
}

bool EllipsoidPiece::inside(Vec3 p) const {
  const Vec3 d = p - origin_;
  const double a = dot(d, axes_[0]), b = dot(d, axes_[1]), c = dot(d, axes_[2]);
  return a * a + b * b + c * c - 1 < 1e-12;
}

ConePiece::ConePiece(Vec3 bottom, Vec3 top, double bottom_radius, double top_radius)
    : middle_(0.5 * (bottom + top)),
      half_(0.5 * (top - bottom)),
      half_squared_(dot(half_, half_)),
      radius_(0.5 * (bottom_radius + top_radius)),
      growth_(0.5 * (top_radius - bottom_radius)),
      aligned_(-1) {
  if (!(half_squared_ > 0))
    throw InputError("cylinder or cone: bottom and top are the same point; move one of them");
  if (!(bottom_radius >= 0 && top_radius >= 0 && radius_ > 0) || !std::isfinite(radius_))
    throw InputError(
        fmt::format("cylinder or cone: radii {} and {}; both must be at least 0, one greater",
                    bottom_radius, top_radius));
  for (int d = 0; d < 3; ++d)
    if (half_[(d + 1) % 3] == 0 && half_[(d + 2) % 3] == 0) aligned_ = d;
  Vec3 disc{};  // half extent of a disc of radius 1
  for (int d = 0; d < 3; ++d)
    disc[d] = std::sqrt(std::max(0.0, 1 - half_[d] * half_[d] / half_squared_));
  bounds_ = with_margin(bounding({bottom - bottom_radius * disc, bottom + bottom_radius * disc},
                                 {top - top_radius * disc, top + top_radius * disc}));
}

bool ConePiece::inside(Vec3 p) const {
  const Vec3 d = p - middle_;
  double along, off_axis;  // in [-1, 1] between the discs; squared distance from the axis
  if (aligned_ >= 0) {
    const double a = d[(aligned_ + 1) % 3], b = d[(aligned_ + 2) % 3];
    if (std::abs(d[aligned_]) > std::abs(half_[aligned_])) return false;
    along = d[aligned_] / half_[aligned_];
    off_axis = a * a + b * b;
  } else {
    const double projection = dot(d, half_);
    if (std::abs(projection) > half_squared_) return false;
    along = projection / half_squared_;
    const Vec3 c = cross(d, half_);
    off_axis = dot(c, c) / half_squared_;
  }
  const double radius = radius_ + along * growth_;
  return off_axis <= radius * radius;
}

PiecePtr make_cylinder(Vec3 bottom, Vec3 top, double radius) {
  return std::make_shared<ConePiece>(bottom, top, radius, radius);
}

TorusPiece::TorusPiece(Vec3 center, double major_radius, double minor_radius, int axis,
                       double theta)
    : center_(center), major_(major_radius), minor_(minor_radius), axis_(axis) {
  require_positive("torus", "major_radius", major_radius);
  require_positive("torus", "minor_radius", minor_radius);
  second_ = axis == 0 ? 1 : axis == 1 ? 2 : 0;
  cosine_ = std::cos(theta);
  sine_ = axis == 2 ? -std::sin(theta) : std::sin(theta);
  Vec3 unit{};
  unit[axis_] = cosine_;
  unit[second_] = sine_;
  Vec3 reach{};
  for (int d = 0; d < 3; ++d)
    reach[d] = major_ * std::sqrt(std::max(0.0, 1 - unit[d] * unit[d])) + minor_;
  bounds_ = with_margin({center - reach, center + reach});
}

bool TorusPiece::inside(Vec3 p) const {
  const Vec3 d = p - center_;
  const double along = cosine_ * d[axis_] + sine_ * d[second_];
  const double across = cosine_ * d[second_] - sine_ * d[axis_];
  const double third = d[3 - axis_ - second_];
  const double ring = major_ - std::sqrt(across * across + third * third);
  return ring * ring + along * along < minor_ * minor_;
}

}  // namespace sluice
