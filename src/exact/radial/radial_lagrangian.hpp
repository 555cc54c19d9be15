// One-dimensional Euler equations with planar, cylindrical or spherical symmetry, cells moving with
// the gas: the reference where no closed form exists (explosions, interacting blast waves).
//
// Mass never crosses a face, so contacts stay as sharp as they started, and cells gather where
// shocks compress. Godunov's method with limited slopes of velocity and pressure, half a step
// predicted, and two-shock Riemann problems; mass and total energy are kept to round-off:
//   r' = u_f,  m dv/dt = -[A p_f] + p (A+ - A-),  m de/dt = -[A p_f u_f]
// with A the mean of the area while the face moves, so that volumes are exact.
// References: B. van Leer, J. Comput. Phys. 32 (1979) 101-136; E. F. Toro, Riemann Solvers and
// Numerical Methods for Fluid Dynamics, 3rd ed. (Springer, 2009), sections 9.4 and 17.1;
// P. Woodward and P. Colella, J. Comput. Phys. 54 (1984) 115-173, section IV (blast waves).
// Limit: one ideal gas; second order in smooth flow, first at shocks.
#pragma once
#include <vector>

#include "exact/radial/radial_problem.hpp"

namespace sluice::exact {

class RadialLagrangian {
 public:
  explicit RadialLagrangian(RadialProblem problem);

  void advance_to(double t);  // from the present time on, s
  double time() const { return time_; }
  const RadialProblem& problem() const { return problem_; }

  // Linear between cell centres.
  RadialState at(double r) const;
  // Integrals over the domain, J and kg per m^2 of area, rad of angle and m of length, or solid
  // angle.
  double total_energy() const;
  double total_mass() const;

 private:
  std::size_t cells() const { return mass_.size(); }
  void place_faces();
  void mirror();
  double stable_step() const;
  void predict(double dt);
  void find_faces();
  void move(double dt);

  RadialProblem problem_;
  double time_ = 0;
  std::vector<double> face_, face_u_, face_p_;
  std::vector<double> mass_, energy_;         // cells; energy per mass, kinetic included
  std::vector<double> centre_, rho_, u_, p_;  // cells with one ghost at either end
  std::vector<double> u_lo_, u_hi_, p_lo_, p_hi_, p_half_;  // cells with ghosts
};

}  // namespace sluice::exact
