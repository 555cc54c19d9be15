// Noh's problem: cold gas running onto a plane, an axis or a point, and the shock that it throws.
//
// Behind the shock, which runs out at (g-1)/2 of the inflow speed, the gas is at rest with density
// rho0 ((g+1)/(g-1))^d; ahead it is squeezed to rho0 (1 + u0 t / r)^(d-1).
// Reference: W. F. Noh, Errors for calculations of strong shocks using an artificial viscosity and
// an artificial heat flux, J. Comput. Phys. 72 (1987) 78-120, section 2.
// Limit: the pressure ahead is taken as zero in the shock relations (error of order 1/Mach^2).
// SI units: kg/m^3, m/s, Pa, m, s.
#pragma once
#include "exact/base/exact_solution.hpp"
#include "exact/base/symmetry.hpp"

namespace sluice::exact {

class Noh final : public ExactSolution {
 public:
  struct Inflow {
    int dimension = 1;
    double gamma = 5.0 / 3.0, density = 1, speed = 1;
    double pressure = 0;  // of the gas ahead, reported as it is
    Vec3 origin;
    Vec3 axis{1, 0, 0};
  };
  explicit Noh(Inflow inflow) : inflow_(inflow) {}

  double shock_radius(double t) const { return 0.5 * (inflow_.gamma - 1) * inflow_.speed * t; }
  double plateau_density() const;
  double plateau_pressure() const;
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override {
    return varies_radially(inflow_.dimension, inflow_.axis, d);
  }

 private:
  Inflow inflow_;
};

}  // namespace sluice::exact
