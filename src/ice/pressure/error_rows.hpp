// R of a row of cells, the relative error of their volume, given the rise of the pressure.
//
//   R = { (1 - g1)(p - X-) + al [dp - 2 sum_d h_d u_d sp_d] - d } / (al K),   K = rho c^2
// The sum is the advection of the pressure through the cell's centre in the whole step: X stands at
// a fixed place, dp is of the moving matter. sp is the part of the slope above the weight's; what
// flows along the weight is in the sum as well: 2 h_d u_d (sp_d + g_d dx_d rho + f_d dx_d).
#pragma once
#include "ice/pressure/variables.hpp"

namespace sluice::ice::pressure {

struct ErrorReads {
  In pressure, work, increment, velocity, pressure_slope, rho;
  Axes axes;
  Vec3 gravity, force;
};

inline ErrorReads read_error(TaskBuilder& task, const ErrorInput& v, const SchemeOptions& o) {
  ErrorReads h;
  h.pressure = task.read(v.pressure);
  h.work = task.read(v.solve.work);
  h.increment = task.read(v.solve.increment);
  h.velocity = task.read(v.moving.velocity);
  h.pressure_slope = task.read(v.pressure_slope);
  h.rho = task.read(v.moving.rho);
  h.gravity = o.forces.on ? o.forces.gravity : Vec3{};
  h.force = o.forces.driving;
  return h;
}

// R has no unit; dp and K = rho c^2 in Pa.
template <int D>
class ErrorRows {
 public:
  ErrorRows(const Row& row, const ErrorReads& h, const Axes& axes)
      : s_(solve_constants(row.step())),
        p_(row(h.pressure)),
        X_(row(h.work)),
        d_(row(h.increment)),
        r_(row(h.rho)) {
    for (int a = 0; a < D; ++a) {
      const double dx = row.step().spacing[axes.direction[a]];
      u_[a] = row(h.velocity, a);
      sp_[a] = row(h.pressure_slope, a);
      twice_h_[a] = row.step().dt / dx;
      g_dx_[a] = h.gravity[axes.direction[a]] * dx;
      f_dx_[a] = h.force[axes.direction[a]] * dx;
    }
  }
  double at(int i, double dp, double K) const {
    return (s_.old_share * (p_[i] - X_[i]) + s_.al * (dp - carried(i)) - d_[i]) / (s_.al * K);
  }
  // V R of a cell of which the fluid has the fraction V, and of that so much more in the step.
  double beside_solids(int i, double V, double growth, double K) const {
    const double rest = s_.old_share * (p_[i] - X_[i]) - s_.al * carried(i) - d_[i];
    return (V * rest) / (s_.al * K) - growth;
  }

 private:
  double carried(int i) const {
    double sum = 0;
    for (int a = 0; a < D; ++a)
      sum += twice_h_[a] * u_[a][i] * (sp_[a][i] + (g_dx_[a] * r_[i] + f_dx_[a]));
    return sum;
  }

  SolveConstants s_;
  const double *p_, *X_, *d_, *r_, *u_[D], *sp_[D];
  double twice_h_[D], g_dx_[D], f_dx_[D];
};

}  // namespace sluice::ice::pressure
