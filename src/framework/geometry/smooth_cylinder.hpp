// The smoothcyl piece: a sector of a thick-walled cylinder that a particle method fills with rings
// of particles fitted to the body.
//
// Angles are in degrees and counted from a reference direction normal to the axis n = top - bottom:
// e1 = (0,1,0) x n when the axis is not along y, else (1,0,0); e2 = n x e1. For the usual axis +z,
// e1 = +x and e2 = +y. End caps lengthen the cylinder at both ends. Points and lengths in m.
#pragma once
#include <string>

#include "framework/geometry/round.hpp"

namespace sluice {

struct SmoothCylinder {
  Vec3 bottom{}, top{};
  double inner_radius = 0, outer_radius = 0;
  double arc_start_angle = 0, arc_angle = 360;  // degrees
  double endcap_thickness = 0;
  // How particles are laid out: pie_slices or constant_particle_volumes.
  std::string discretization_scheme;
  int num_radial = 1, num_axial = 1, num_angular = 1;
};

class SmoothCylinderPiece final : public GeometryPiece {
 public:
  explicit SmoothCylinderPiece(const SmoothCylinder& cylinder);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return outside_.bounds(); }
  const SmoothCylinder& cylinder() const { return cylinder_; }

 private:
  SmoothCylinder cylinder_;
  Vec3 middle_, axis_, e1_, e2_;  // axis: unit vector
  ConePiece outside_;
};

}  // namespace sluice
