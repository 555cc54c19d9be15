#include "mpm/loads/load_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "framework/geometry/round.hpp"

namespace sluice::mpm {
namespace {

double length(Vec3 v) {
  return std::sqrt(dot(v, v));
}

}  // namespace

LoadSurface::LoadSurface(const LoadCurve& load, bool axisymmetric,
                         const std::array<bool, 3>& active)
    : axisymmetric_(axisymmetric) {
  if (load.on_points) {
    area_ = load.area;
    return;
  }
  if (load.shape == "box") {
    set_box(load.piece->bounds(), active);
    return;
  }
  if (const auto* sphere = dynamic_cast<const SpherePiece*>(load.piece.get())) {
    shape_ = Shape::sphere;
    origin_ = sphere->origin();
    radius_ = sphere->radius();
    area_ = 4 * std::numbers::pi * radius_ * radius_;
    return;
  }
  if (const auto* cylinder = dynamic_cast<const ConePiece*>(load.piece.get())) {
    set_cylinder(load, cylinder->bottom(), cylinder->top(), cylinder->middle_radius());
    return;
  }
  throw std::invalid_argument("a load acts on a box, cylinder or sphere, not on a " + load.shape);
}

void LoadSurface::set_box(const Bounds& box, const std::array<bool, 3>& active) {
  shape_ = Shape::box;
  box_ = box;
  const Vec3 size = box.upper - box.lower;
  const auto moves = [&](int d) { return active[d]; };
  while (thin_ < 2 && !moves(thin_)) ++thin_;
  for (int d = thin_ + 1; d < 3; ++d)
    if (moves(d) && size[d] < size[thin_]) thin_ = d;
  for (int d = 0; d < 3; ++d)
    bulky_ = bulky_ || (d != thin_ && moves(d) && !(size[thin_] < 0.5 * size[d]));
  area_ = size[(thin_ + 1) % 3] * size[(thin_ + 2) % 3];
}

void LoadSurface::set_cylinder(const LoadCurve& load, Vec3 bottom, Vec3 top, double radius) {
  const bool end = load.ends || load.axisymmetric_end;
  shape_ = end ? Shape::cylinder_end : Shape::cylinder_side;
  origin_ = bottom;
  height_ = length(top - bottom);
  axis_ = (1 / height_) * (top - bottom);
  radius_ = radius;
  if (load.axisymmetric_end)
    area_ = 0.5 * radius * radius;  // of one radian
  else if (end)
    area_ = std::numbers::pi * radius * radius;
  else
    area_ = (load.axisymmetric_side ? 1 : 2 * std::numbers::pi) * radius * height_;
}

Vec3 LoadSurface::arm(Vec3 x) const {
  const Vec3 d = x - origin_;
  if (shape_ == Shape::sphere) return d;
  return d - dot(d, axis_) * axis_;
}

bool LoadSurface::holds(Vec3 x, Vec3 spacing) const {
  const double least = std::min({spacing.x, spacing.y, spacing.z});
  switch (shape_) {
    case Shape::box: {
      Bounds wide = box_;
      wide.lower[thin_] -= spacing[thin_];
      wide.upper[thin_] += spacing[thin_];
      return wide.contains(x);
    }
    case Shape::cylinder_side: {
      const double along = dot(x - origin_, axis_);
      return along >= 0 && along <= height_ && std::fabs(length(arm(x)) - radius_) <= 1.2 * least;
    }
    case Shape::cylinder_end: {
      double along_axis = 0;
      for (int d = 0; d < 3; ++d) along_axis += std::fabs(axis_[d]) * spacing[d];
      const double along = dot(x - origin_, axis_);
      return along >= -along_axis && along <= height_ + along_axis && length(arm(x)) <= radius_;
    }
    case Shape::sphere:
      return std::fabs(length(arm(x)) - radius_) <= length(spacing);
    case Shape::points:
      return false;
  }
  return false;
}

Vec3 LoadSurface::direction(Vec3 x) const {
  if (shape_ == Shape::box) {
    Vec3 n{};
    n[thin_] = 1;
    return n;
  }
  if (shape_ == Shape::cylinder_end) return axis_;
  if (axisymmetric_) return {1, 0, 0};  // x is the distance from the axis
  const Vec3 d = arm(x);
  const double r = length(d);
  return r > 0 ? (1 / r) * d : Vec3{};
}

}  // namespace sluice::mpm
