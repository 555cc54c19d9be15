// The smoothcyl piece: a sector of a thick-walled cylinder.
#include "framework/geometry/smooth_cylinder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice {

namespace {

Vec3 unit(Vec3 a) {
  return (1 / std::sqrt(dot(a, a))) * a;
}

Vec3 axis_of(const SmoothCylinder& c) {
  const Vec3 axis = c.top - c.bottom;
  if (!(dot(axis, axis) > 0))
    throw InputError("smoothcyl: bottom and top are the same point; move one of them");
  return unit(axis);
}

void check(const SmoothCylinder& c) {
  if (!(c.inner_radius >= 0 && c.inner_radius < c.outer_radius))
    throw InputError(
        fmt::format("smoothcyl: inner_radius {} and outer_radius {}; needed is 0 <= inner < outer",
                    c.inner_radius, c.outer_radius));
  if (!(c.arc_angle > 0 && c.arc_angle <= 360))
    throw InputError(
        fmt::format("smoothcyl: arc_angle is {}; it must be in (0, 360] degrees", c.arc_angle));
  if (!(c.arc_start_angle >= 0 && c.arc_start_angle <= 360))
    throw InputError(fmt::format("smoothcyl: arc_start_angle is {}; it must be in [0, 360] degrees",
                                 c.arc_start_angle));
  if (!(c.endcap_thickness >= 0))
    throw InputError(fmt::format("smoothcyl: endcap_thickness is {}; it must be at least 0",
                                 c.endcap_thickness));
  if (c.num_radial < 1 || c.num_axial < 1 || c.num_angular < 1)
    throw InputError("smoothcyl: num_radial, num_axial and num_angular must be at least 1");
}

}  // namespace

SmoothCylinderPiece::SmoothCylinderPiece(const SmoothCylinder& c)
    : cylinder_(c),
      middle_(0.5 * (c.bottom + c.top)),
      axis_(axis_of(c)),
      outside_(c.bottom - c.endcap_thickness * axis_, c.top + c.endcap_thickness * axis_,
               c.outer_radius, c.outer_radius) {
  check(c);
  const Vec3 across = cross({0, 1, 0}, axis_);
  e1_ = dot(across, across) > 1e-24 ? unit(across) : Vec3{1, 0, 0};
  e2_ = cross(axis_, e1_);
}

bool SmoothCylinderPiece::inside(Vec3 p) const {
  if (!outside_.inside(p)) return false;
  const Vec3 d = p - middle_;
  const Vec3 c = cross(d, axis_);
  if (dot(c, c) < cylinder_.inner_radius * cylinder_.inner_radius) return false;
  if (cylinder_.arc_angle >= 360) return true;
  double angle = std::atan2(dot(d, e2_), dot(d, e1_)) * (180 / std::numbers::pi);
  angle -= cylinder_.arc_start_angle;
  angle -= 360 * std::floor(angle / 360);  // into [0, 360)
  return angle <= cylinder_.arc_angle;
}

}  // namespace sluice
