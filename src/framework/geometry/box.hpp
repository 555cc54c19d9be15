// Pieces with flat faces: box, parallelepiped, convex polyhedron. Points in m; normals of any
// length. Constructors throw InputError for a piece without volume or of infinite extent.
#pragma once
#include <array>

#include "framework/geometry/piece.hpp"

namespace sluice {

// min <= p <= max.
class BoxPiece final : public GeometryPiece {
 public:
  BoxPiece(Vec3 min, Vec3 max);
  bool inside(Vec3 p) const override { return box_.contains(p); }
  Bounds bounds() const override { return box_; }
  Cover cover(const Bounds& box) const override;

 private:
  Bounds box_;
};

// p1 + a (p2-p1) + b (p3-p1) + c (p4-p1) with 0 < a, b, c <= 1: a, b, c from Cramer's rule.
class ParallelepipedPiece final : public GeometryPiece {
 public:
  ParallelepipedPiece(Vec3 p1, Vec3 p2, Vec3 p3, Vec3 p4);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override { return convex_cover(*this, box, false); }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> normals_;  // cross products of the two other edges
  double volume_;                // signed
  Bounds bounds_;
};

// The points p with (p - point) . normal >= 0.
struct HalfSpace {
  Vec3 point{}, normal{};
};

// Intersection of half spaces that holds `center` and encloses a finite volume.
class PolyhedronPiece final : public GeometryPiece {
 public:
  PolyhedronPiece(Vec3 center, std::vector<HalfSpace> faces);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override { return convex_cover(*this, box, false); }

 private:
  std::vector<HalfSpace> faces_;
  Bounds bounds_;
};

}  // namespace sluice
