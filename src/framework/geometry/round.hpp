// Pieces with curved faces: sphere, ellipsoid, cylinder, cone, torus. Points and lengths in m.
// Constructors throw InputError for radii and axes that leave no volume.
//
// Cylinders and cones are measured from the middle of their axis, so that the piece with bottom and
// top exchanged, and its mirror image, give the same answer to the bit.
#pragma once
#include <algorithm>
#include <array>

#include "framework/geometry/piece.hpp"

namespace sluice {

class SpherePiece final : public GeometryPiece {
 public:
  SpherePiece(Vec3 origin, double radius);
  bool inside(Vec3 p) const override {
    const Vec3 d = p - origin_;
    return dot(d, d) <= radius_ * radius_;
  }
  Bounds bounds() const override {
    return with_margin({origin_ - Vec3::all(radius_), origin_ + Vec3::all(radius_)});
  }
  // None where even the nearest point of the box is outside: all operations of inside() are
  // monotone in |p - o| along each direction, round-off included.
  Cover cover(const Bounds& box) const override {
    if (!inside(nearest_of(box))) return Cover::none;
    return convex_cover(*this, box, true);
  }
  Vec3 origin() const { return origin_; }
  double radius() const { return radius_; }

 private:
  Vec3 nearest_of(const Bounds& box) const {
    Vec3 p;
    for (int d = 0; d < 3; ++d) p[d] = std::clamp(origin_[d], box.lower[d], box.upper[d]);
    return p;
  }
  Vec3 origin_;
  double radius_;
};

// sum of (d . v_i / |v_i|^2)^2 <= 1 + 1e-12 for three orthogonal half axes v_i.
class EllipsoidPiece final : public GeometryPiece {
 public:
  EllipsoidPiece(Vec3 origin, Vec3 v1, Vec3 v2, Vec3 v3);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override { return convex_cover(*this, box, false); }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> axes_;  // v_i / |v_i|^2
  Bounds bounds_;
};

// Frustum between two discs; a cylinder is one with equal radii.
class ConePiece final : public GeometryPiece {
 public:
  ConePiece(Vec3 bottom, Vec3 top, double bottom_radius, double top_radius);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override { return convex_cover(*this, box, false); }
  Vec3 bottom() const { return middle_ - half_; }
  Vec3 top() const { return middle_ + half_; }
  double middle_radius() const { return radius_; }  // of a cylinder everywhere

 private:
  Vec3 middle_, half_;  // centre of the axis, vector from there to the top
  double half_squared_;
  double radius_, growth_;  // at the middle; from there to the top
  int aligned_;             // direction of the axis, or -1
  Bounds bounds_;
};

PiecePtr make_cylinder(Vec3 bottom, Vec3 top, double radius);

// (major - sqrt(a^2 + b^2))^2 + c^2 < minor^2, c along the axis. The axis is turned by theta
// (radians): z in the z-x plane, y in the z-y plane, x in the y-x plane.
class TorusPiece final : public GeometryPiece {
 public:
  TorusPiece(Vec3 center, double major_radius, double minor_radius, int axis, double theta);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }

 private:
  Vec3 center_;
  double major_, minor_;
  int axis_, second_;  // the axis turns towards `second_`
  double cosine_, sine_;
  Bounds bounds_;
};

}  // namespace sluice
