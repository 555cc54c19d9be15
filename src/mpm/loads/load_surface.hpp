// The surface on which a load acts: which particles feel it, its area, the direction of the force.
//
// The thin direction of a box is one in which something moves: across a direction of one cell no
// surface has an area.
//
// A particle at the surface of its body feels the load if it lies in the piece of the load, widened
// by what lattices of particles leave between themselves and a surface: a box by the spacing of the
// particles along its thin direction, a cylinder or sphere by 1.2 of their least spacing or by
// their spacing to both sides of its radius. Lengths in m.
#pragma once
#include <array>

#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

class LoadSurface {
 public:
  enum class Shape { box, cylinder_side, cylinder_end, sphere, points };

  // std::invalid_argument for a piece that is none of these.
  explicit LoadSurface(const LoadCurve& load, bool axisymmetric = false,
                       const std::array<bool, 3>& active = {true, true, true});

  Shape shape() const { return shape_; }
  // `spacing`: widths of the particle, length.
  bool holds(Vec3 x, Vec3 spacing) const;
  // Is the thin direction of a box not thin after all: half as wide as the next one that moves.
  bool is_bulky() const { return bulky_; }
  // Over which a pressure acts, length^2.
  double area() const { return area_; }
  // Unit vector: of a box its thin direction (upwards; the load has the sign), of a cylinder or
  // sphere outward from the axis or the centre, of an end from bottom to top.
  Vec3 direction(Vec3 x) const;
  // From the axis to the place, and the unit vector of the axis (cylinders).
  Vec3 arm(Vec3 x) const;
  Vec3 axis() const { return axis_; }

 private:
  void set_box(const Bounds& box, const std::array<bool, 3>& active);
  void set_cylinder(const LoadCurve& load, Vec3 bottom, Vec3 top, double radius);

  Shape shape_ = Shape::points;
  bool axisymmetric_, bulky_ = false;
  Bounds box_{};
  int thin_ = 0;
  Vec3 origin_{}, axis_{};  // bottom of a cylinder, or centre; unit vector
  double height_ = 0, radius_ = 0, area_ = 0;
};

}  // namespace sluice::mpm
