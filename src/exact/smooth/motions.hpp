// Manufactured motions of solids: where each of their points is. m and s.
//
// Reference: K. Kamojjala, R. Brannon, A. Sadeghirad, J. Guilkey, Eng. Comput. 31 (2015) 193-213.
#pragma once
#include "exact/base/exact_solution.hpp"

namespace sluice::exact {

class Motion : public ExactSolution {
 public:
  // Throws InputError: a motion knows places alone.
  State at(Vec3 x, double t) const override;
  bool has_places() const override { return true; }
};

// Circles of a ring of mean radius 1 turn about the axis z by (A/2)(1 - cos 2 pi t) h(R),
// h = (16 (R - 1)^2 - 1)^2; A in rad.
class VortexRing final : public Motion {
 public:
  explicit VortexRing(double amplitude) : amplitude_(amplitude) {}
  Vec3 place(Vec3 X, double t) const override;

 private:
  double amplitude_;
};

// u_d = +-A sin(2 pi X_d) sin(c pi t) along the first `directions`, - along y; A in m, c in 1/s.
class AxisAligned final : public Motion {
 public:
  AxisAligned(double amplitude, double speed, int directions)
      : amplitude_(amplitude), speed_(speed), directions_(directions) {}
  Vec3 place(Vec3 X, double t) const override;

 private:
  double amplitude_, speed_;
  int directions_;
};

}  // namespace sluice::exact
