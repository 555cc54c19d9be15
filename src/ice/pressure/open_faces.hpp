// Open faces (LODI) of the semi-implicit step: waves leave, whatever the step is to them.
//
//   D = dt/(rho dx),  Z = rho min(c, dx/(2 dt)),  K = sigma (1 - M^2) c dt/L
//   pt  = (X-_a + K p_inf)/(1 + K)
//   u_f = (u* + D (X_a - pt + Z u_a))/(1 + D Z),   p_f = pt + Z (u_f - u_a)      (u outward)
// At small C the face is an impedance rho c: no reflection; at large C a given pressure that starts
// softly. K pulls towards the pressure far away (Rudy and Strikwerda, J. Comput. Phys. 36 (1980)
// 55), implicitly.
#pragma once
#include <algorithm>

#include "ice/boundary/boundary_fill.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {

// The cell inside: kg/m^3, m/s; velocity along the axis, m/s; X- without d, Pa.
struct OpenCell {
  double rho, c, u, work;
};

struct OpenFace {
  double D, Z, far, u_a;  // m^2 s/kg; kg/(m^2 s); pt, Pa; outward, m/s
  double sign;            // of outward along the axis

  // m/s, from u* (m/s) and X (Pa).
  double velocity(double star, double X) const {
    return sign * (sign * star + D * (X - far + Z * u_a)) / (1.0 + D * Z);
  }
  // Pa, from u_f (m/s).
  double pressure(double u) const { return far + Z * (sign * u - u_a); }
  // d u_f/d X, m^2 s/kg.
  double slope() const { return D / (1.0 + D * Z); }
};

inline OpenFace open_face(const Row& row, const SchemeOptions& o, int axis, int i, bool plus,
                          const OpenCell& cell) {
  const int d = o.grid.axes.direction[axis];
  const double dx = row.step().spacing[d], dt = row.step().dt;
  IntVec3 at = row.cell();
  at[o.grid.axes.direction[0]] += i;
  const BoundaryFill::FarPressure far = o.grid.boundary->far_pressure(side_of(d, plus), at);
  const double mach = std::min(std::fabs(cell.u) / cell.c, 1.0);
  const double K = far.sigma * (1.0 - mach * mach) * cell.c * dt / far.length;
  OpenFace f{};
  f.sign = plus ? 1.0 : -1.0;
  f.D = dt / (cell.rho * dx);
  f.Z = cell.rho * std::min(cell.c, 0.5 * dx / dt);
  f.far = (cell.work + K * far.pressure) / (1.0 + K);
  f.u_a = f.sign * cell.u;
  return f;
}

}  // namespace sluice::ice::pressure
