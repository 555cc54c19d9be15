// Manufactured solutions: a motion x = X + u(X, t), and the body force that a solid with the law
//   sigma = (lambda ln J I + G (F F^T - I))/J
// needs to move like that. P. C. Wallstedt, J. E. Guilkey, J. Comput. Phys. 227 (2008) 9628; the
// vortex: K. Kamojjala et al., Eng. Comput. 31 (2015) 219. Equations: docs/theory/mpm_loads.md.
#pragma once
#include <memory>
#include <string>

#include "framework/base/vec3.hpp"

namespace sluice::mpm {

struct ManufacturedConstants {
  double density = 1;            // rho_0, kg/m^3
  double lambda = 0, shear = 1;  // Lame's constants, Pa
  double amplitude = 0;          // of the motion, m (a vortex: rad); 0: that of the problem
  Vec3 active{1, 1, 1};          // 0: nothing moves along this direction
};

class Manufactured {
 public:
  virtual ~Manufactured() = default;
  virtual Vec3 displacement(Vec3 X, double t) const = 0;  // of the particle that was at X, m
  virtual Vec3 velocity(Vec3 X, double t) const = 0;      // m/s
  virtual Vec3 body_force(Vec3 X, double t) const = 0;    // per mass, m/s^2
};

// RunMMSProblem: AxisAligned, AxisAligned3L, GeneralizedVortex, ExpandingRing.
// std::invalid_argument
// for any other name.
std::unique_ptr<Manufactured> manufactured(const std::string& name,
                                           const ManufacturedConstants& constants);

}  // namespace sluice::mpm
