// Thin pieces about a middle surface: plane, sphere and cylinder shells, sphere membrane.
#include "framework/geometry/shell.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "framework/geometry/round.hpp"

namespace sluice {

namespace {

void require_thin(const char* piece, double radius, double thickness) {
  if (!(thickness > 0) || !(0.5 * thickness < radius))
    throw InputError(fmt::format(
        "{}: thickness {} with radius {}; the thickness must be greater than 0 and below twice the "
        "radius",
        piece, thickness, radius));
}

double squared(double a) {
  return a * a;
}

// inner <= distance from the origin <= outer.
class SphereShellPiece final : public GeometryPiece {
 public:
  SphereShellPiece(Vec3 origin, double inner, double outer)
      : outside_(origin, outer), origin_(origin), inner_(inner) {}
  bool inside(Vec3 p) const override {
    const Vec3 d = p - origin_;
    return dot(d, d) >= squared(inner_) && outside_.inside(p);
  }
  Bounds bounds() const override { return outside_.bounds(); }

 private:
  SpherePiece outside_;
  Vec3 origin_;
  double inner_;
};

// Between two coaxial cylinders; the inner surface belongs to the shell.
class CylinderShellPiece final : public GeometryPiece {
 public:
  CylinderShellPiece(Vec3 bottom, Vec3 top, double inner, double outer)
      : outside_(bottom, top, outer, outer),
        middle_(0.5 * (bottom + top)),
        half_(0.5 * (top - bottom)),
        inner_(inner) {}
  bool inside(Vec3 p) const override {
    if (!outside_.inside(p)) return false;
    const Vec3 c = cross(p - middle_, half_);
    return dot(c, c) >= squared(inner_) * dot(half_, half_);
  }
  Bounds bounds() const override { return outside_.bounds(); }

 private:
  ConePiece outside_;
  Vec3 middle_, half_;
  double inner_;
};

}  // namespace

PiecePtr make_plane_shell(Vec3 center, Vec3 normal, double radius, double thickness) {
  const double length = std::sqrt(dot(normal, normal));
  if (!(length > 0)) throw InputError("plane_shell: the normal is a zero vector");
  if (!(thickness > 0))
    throw InputError(
        fmt::format("plane_shell: thickness is {}; it must be greater than 0", thickness));
  const Vec3 half = (0.5 * thickness / length) * normal;
  return make_cylinder(center - half, center + half, radius);
}

PiecePtr make_sphere_shell(Vec3 origin, double radius, double thickness) {
  require_thin("sphere_shell or sphere_membrane", radius, thickness);
  return std::make_shared<SphereShellPiece>(origin, radius - 0.5 * thickness,
                                            radius + 0.5 * thickness);
}

PiecePtr make_cylinder_shell(Vec3 bottom, Vec3 top, double radius, double thickness) {
  require_thin("cylinder_shell", radius, thickness);
  return std::make_shared<CylinderShellPiece>(bottom, top, radius - 0.5 * thickness,
                                              radius + 0.5 * thickness);
}

}  // namespace sluice
